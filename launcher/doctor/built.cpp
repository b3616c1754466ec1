// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/doctor/built.hpp"

#include <cstdlib>
#include <set>

#include "launcher/doctor/command_output.hpp"
#include "launcher/doctor/loaded_libraries.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

// Scripts are copied when the build is configured, programs and modules are linked.
Diagnosis missing_file(const fs::path& file, bool installed) {
    if (installed) return {Health::missing, file.filename(), "not installed", reinstall_command};
    const std::string again =
        file.extension() == ".py" ? std::string("rm -f build/release/.configured; ") : "";
    return {Health::missing, file.filename(), "not built", again + build_command};
}

Diagnosis look_at(const fs::path& file, bool installed) {
    if (!fs::exists(file)) return missing_file(file, installed);
    const LoadedLibraries libraries = loaded_libraries(file);
    if (libraries.absent.empty())
        return {Health::ok, file.filename(), installed ? "installed" : "built", ""};
    return {Health::wrong, file.filename(), "does not find " + libraries.absent,
            installed ? reinstall_command : build_command};
}

std::vector<fs::path> files_of_build(const Programs& programs) {
    const fs::path yade = programs.yade_folder();
    return {programs.coupler(),
            programs.member(),
            programs.fluid(FluidProgram::openfoam),
            programs.fluid(FluidProgram::box),
            programs.folder / "turbidite-grains",
            programs.folder / "turbidite-grains-md",
            programs.folder / "turbidite-lammps",
            programs.library / "libturbidite.so",
            programs.python_module() / "turbidite_adapter.py",
            programs.yade_extension(),
            yade / "turbidite_contact_engine.so",
            yade / "turbidite_yade_nscd.py",
            yade / "turbidite_yade_md.py"};
}

/// mpi4py's module, which is loaded by grains programs in Python; empty without mpi4py.
fs::path mpi4py_module(const Programs& programs) {
    const CommandOutput output =
        output_of({programs.python(), "-c",
                   "import importlib.util as u; print(u.find_spec('mpi4py.MPI').origin)"});
    return output.code == 0 ? first_words(output.text) : "";
}

// A search path set by hand is what usually brings a second MPI.
std::string libmpi_remedy(bool installed) {
    if (std::getenv("LD_LIBRARY_PATH")) return "unset LD_LIBRARY_PATH";
    return installed ? reinstall_command : std::string("rm -r build/release; ") + build_command;
}

Diagnosis one_libmpi(std::vector<fs::path> files, const fs::path& mpi4py, bool installed) {
    if (!mpi4py.empty()) files.push_back(mpi4py);
    std::set<std::string> found;
    for (const fs::path& file : files) {
        const std::string mpi = fs::exists(file) ? loaded_libraries(file).mpi : "";
        if (!mpi.empty()) found.insert(mpi);
    }
    if (found.size() == 1) return {Health::ok, "one libmpi", *found.begin(), ""};
    std::string all;
    for (const std::string& library : found) all += (all.empty() ? "" : " and ") + library;
    return {Health::wrong, "one libmpi", found.empty() ? "none is found" : all,
            libmpi_remedy(installed)};
}

}  // namespace

Diagnoses built_programs(const Programs& programs) {
    const std::vector<fs::path> files = files_of_build(programs);
    Diagnoses diagnoses;
    for (const fs::path& file : files) diagnoses.push_back(look_at(file, programs.installed));
    diagnoses.push_back(one_libmpi(files, mpi4py_module(programs), programs.installed));
    return diagnoses;
}

}  // namespace turbidite
