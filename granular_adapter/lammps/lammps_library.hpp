// SPDX-License-Identifier: GPL-2.0-or-later
//
// LAMMPS inside this process, through its C library. Its errors arrive as LammpsError: Debian's
// library is built without exceptions and would call MPI_Finalize and exit() instead, which would
// hang the other programs of the job, so the functions that do it are replaced
// (lammps_library.cpp).
#pragma once

#include <mpi.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace turbidite::lammps {

class LammpsError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

class Library {
 public:
    /// LAMMPS on all ranks of the communicator, without output of its own. Throws LammpsError if it
    /// lacks the granular package.
    explicit Library(MPI_Comm communicator);
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    /// The release as a date: 20210929.
    int version() const;

    /// One line of an input script; collective. Throws LammpsError with LAMMPS' own text.
    void command(const std::string& line);

    /// Grains that this rank owns; they come first in all arrays, followed by copies of other
    /// ranks' grains.
    int local_count() const;

    /// Steps since the start.
    std::int64_t step() const;

    /// The array of a quantity of all grains, such as "x" or "d2_name". It moves when grains do.
    template <class T>
    T atoms(const char* name) const {
        return static_cast<T>(array(name));
    }

    void* handle() const { return handle_; }

 private:
    void* array(const char* name) const;

    void* handle_ = nullptr;
};

}  // namespace turbidite::lammps
