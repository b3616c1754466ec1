// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/programs.hpp"

#include "coupler/protocol/failure.hpp"

namespace turbidite {

Programs find_programs() {
    const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    Programs programs;
    programs.folder = folder;
    programs.library = folder.parent_path() / "lib";
    // PREFIX/lib/turbidite/bin, as cmake/install.cmake places it.
    const auto shared = (folder / "../../../share/turbidite").lexically_normal();
    programs.installed = std::filesystem::exists(shared / "launcher/report/report.py");
    programs.source = programs.installed ? shared : std::filesystem::path(TURBIDITE_SOURCE_DIR);
    return programs;
}

void require_checkout(const Programs& programs, const std::string& what) {
    if (!programs.installed) return;
    throw Failure(ExitCode::bad_input,
                  "turbidite: the " + what +
                      " are not installed with the program\n  They belong to the sources: "
                      "./turbidite in the top folder of a checkout builds and runs them.");
}

}  // namespace turbidite
