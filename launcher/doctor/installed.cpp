// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/doctor/installed.hpp"

#include "launcher/doctor/command_output.hpp"

namespace turbidite {
namespace {

/// A program or module, and the Debian package it comes from.
struct Software {
    std::string name, package;
    std::vector<std::string> command;  ///< prints the version
    std::string before_version;        ///< the text in front of it
    std::string mend = {};             ///< if it fails; empty: the command, to see its words
    std::string without = {};          ///< what works without it
};

bool is_missing(const CommandOutput& output) {
    return output.code == 127 || output.text.find("ModuleNotFoundError") != std::string::npos;
}

Diagnosis look_at(const Software& software) {
    const CommandOutput output = output_of(software.command);
    const std::string remedy = install_command(software.package);
    if (is_missing(output))
        return {Health::missing, software.name, "not installed" + software.without, remedy};
    const std::string version = word_after(software.before_version, output.text);
    if (output.code != 0 || version.empty())
        return {Health::wrong, software.name, first_words(output.text),
                software.mend.empty() ? shell_line(software.command) : software.mend};
    return {Health::ok, software.name, version, ""};
}

Software python_module(const std::string& name, const Programs& programs) {
    return {name,
            "python3-" + name,
            {programs.python(), "-c",
             "import " + name + "; print('version', " + name + ".__version__)"},
            "version ",
            "unset PYTHONPATH"};
}

/// The library alone suffices where nothing is compiled.
Software lammps(const Programs& programs) {
    const std::string package = programs.installed ? "liblammps0" : "liblammps-dev";
    const std::string query = "dpkg-query --show --showformat='version ${Version}' " + package;
    return {"LAMMPS", package, {"sh", "-c", query + " || exit 127"}, "version "};
}

Diagnoses look_at_all(const std::vector<Software>& list) {
    Diagnoses diagnoses;
    for (const Software& software : list) diagnoses.push_back(look_at(software));
    return diagnoses;
}

}  // namespace

Diagnoses installed_software(const LaunchSite& site) {
    const Programs& programs = site.programs;
    return look_at_all({{"OpenFOAM",
                         "openfoam",
                         {"env", "WM_PROJECT_DIR=" + site.openfoam, "blockMesh", "-help"},
                         "OpenFOAM- (",
                         "unset WM_PROJECT_DIR",
                         "; spheres in space are played without it (docs/box-program.md)"},
                        {"YADE", "yade", {programs.yade(), "--version"}, "Yade version: "},
                        lammps(programs),
                        {"Open MPI",
                         "openmpi-bin",
                         {"mpirun", "--version"},
                         "(Open MPI) ",
                         "export PATH=/usr/bin:$PATH"},
                        {"Python", "python3", {programs.python(), "--version"}, "Python "},
                        python_module("numpy", programs),
                        python_module("matplotlib", programs),
                        python_module("mpi4py", programs)});
}

Diagnoses build_tools() {
    return look_at_all({{"g++", "g++", {"g++", "--version"}, ") "},
                        {"CMake", "cmake", {"cmake", "--version"}, "version "},
                        {"Ninja", "ninja-build", {"ninja", "--version"}, ""}});
}

}  // namespace turbidite
