// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/programs.hpp"

namespace turbidite {

Programs find_programs() {
    const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    return {
        .folder = folder, .library = folder.parent_path() / "lib", .source = TURBIDITE_SOURCE_DIR};
}

}  // namespace turbidite
