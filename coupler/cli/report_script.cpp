// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/cli/report_script.hpp"

#include <cstdlib>

#include "coupler/cli/launch_line.hpp"

namespace turbidite {

bool write_report(const RunFolder& folder, const Programs& programs) {
    // -B: no __pycache__ in the source tree.
    const std::string line = shell_line({programs.python(), "-B", programs.report(), folder.root});
    return std::system(line.c_str()) == 0;
}

}  // namespace turbidite
