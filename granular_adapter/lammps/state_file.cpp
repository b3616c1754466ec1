// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/state_file.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace turbidite::lammps {
namespace {

/// Empty if it cannot be made. Throws nothing: the other ranks wait for the name.
std::string new_file() {
    std::error_code missing;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(missing);
    if (missing) return "";
    std::string name = (folder / "turbidite-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) return "";
    close(file);
    return name;
}

}  // namespace

StateFile::StateFile(MPI_Comm communicator) {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    mine_ = rank == 0;
    if (mine_) name_ = new_file();
    int length = int(name_.size());
    MPI_Bcast(&length, 1, MPI_INT, 0, communicator);
    name_.resize(std::size_t(length));
    MPI_Bcast(name_.data(), length, MPI_CHAR, 0, communicator);
    if (name_.empty())
        throw std::runtime_error(
            "no temporary file can be made, which LAMMPS needs for its state: the folder for them "
            "(TMPDIR, or /tmp) is missing, full, or may not be written to");
}

StateFile::~StateFile() {
    if (mine_) unlink(name_.c_str());
}

std::vector<char> StateFile::read() const {
    std::ifstream file(name_, std::ios::binary);
    std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file || bytes.empty())
        throw std::runtime_error("LAMMPS' state in " + name_ + " cannot be read");
    return bytes;
}

void StateFile::write(const std::vector<char>& bytes) const {
    std::ofstream file(name_, std::ios::binary);
    file.write(bytes.data(), std::streamsize(bytes.size()));
    if (!file.flush()) throw std::runtime_error("LAMMPS' state cannot be written to " + name_);
}

}  // namespace turbidite::lammps
