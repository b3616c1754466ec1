// SPDX-License-Identifier: GPL-2.0-or-later
//
// A file for LAMMPS' restart commands, which know no other place for a state. Only the first rank
// reads and writes it; it vanishes with the object.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace turbidite::lammps {

class StateFile {
 public:
    /// An empty file with a name of its own in the folder for temporary files; collective.
    explicit StateFile(MPI_Comm communicator);
    ~StateFile();
    StateFile(const StateFile&) = delete;
    StateFile& operator=(const StateFile&) = delete;

    const std::string& name() const { return name_; }

    /// On the first rank. Throw std::runtime_error naming the file.
    std::vector<char> read() const;
    void write(const std::vector<char>& bytes) const;

 private:
    std::string name_;
    bool mine_ = false;
};

}  // namespace turbidite::lammps
