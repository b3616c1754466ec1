// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/cli/report_script.hpp"

#include <cstdlib>

#include "coupler/cli/launch_line.hpp"

namespace turbidite {

bool write_report(const RunFolder& folder, const Programs& programs) {
    const std::string line = shell_line({programs.python(), programs.report(), folder.root});
    return std::system(line.c_str()) == 0;
}

}  // namespace turbidite
