// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/lammps_library.hpp"

#include <lammps/library.h>

#include <array>
#include <cstdio>

namespace LAMMPS_NS {

// LAMMPS' class of errors, as far as it is replaced here: its headers cannot be included, since
// Debian does not package all of them. Definitions in the program precede those of the shared
// library for the library's own calls too.
class __attribute__((visibility("default"))) Error {
 public:
    [[noreturn]] void all(const std::string&, int, const std::string& text);
    [[noreturn]] void one(const std::string&, int, const std::string& text);
    void warning(const std::string&, int, const std::string& text);
};

void Error::all(const std::string&, int, const std::string& text) {
    throw turbidite::lammps::LammpsError("LAMMPS: " + text);
}

void Error::one(const std::string&, int, const std::string& text) {
    throw turbidite::lammps::LammpsError("LAMMPS on this rank: " + text);
}

void Error::warning(const std::string&, int, const std::string& text) {
    std::fprintf(stderr, "LAMMPS warns: %s\n", text.c_str());
}

}  // namespace LAMMPS_NS

namespace turbidite::lammps {

Library::Library(MPI_Comm communicator) {
    std::array<std::string, 6> words = {"lammps", "-log", "none", "-screen", "none", "-nocite"};
    std::array<char*, 6> arguments{};
    for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
    handle_ = lammps_open(int(arguments.size()), arguments.data(), communicator, nullptr);
    if (!handle_) throw LammpsError("LAMMPS could not be started");
    if (!lammps_has_style(handle_, "pair", "granular"))
        throw LammpsError("this LAMMPS was built without its package GRANULAR");
}

Library::~Library() {
    lammps_close(handle_);
}

int Library::version() const {
    return lammps_version(handle_);
}

void Library::command(const std::string& line) {
    lammps_command(handle_, line.c_str());
}

int Library::local_count() const {
    return lammps_extract_setting(handle_, "nlocal");
}

std::int64_t Library::step() const {
    return *static_cast<const std::int64_t*>(lammps_extract_global(handle_, "ntimestep"));
}

void* Library::array(const char* name) const {
    void* found = lammps_extract_atom(handle_, name);
    // A rank without grains may not have allocated anything yet.
    if (!found && local_count() > 0)
        throw LammpsError(std::string("LAMMPS has no array \"") + name + "\" of its atoms");
    return found;
}

}  // namespace turbidite::lammps
