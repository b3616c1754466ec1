// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/lammps_library.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace turbidite::lammps {
namespace {

std::string refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const LammpsError& error) {
        return error.what();
    }
    return "nothing was refused";
}

// Debian's library would end the process.
TEST(Library, ErrorsOfLammpsAreExceptionsWithItsText) {
    Library lammps(MPI_COMM_WORLD);
    EXPECT_EQ(refusal([&] { lammps.command("sing a song"); }),
              "LAMMPS: Unknown command: sing a song");
    EXPECT_EQ(refusal([&] { lammps.command("fix 1 all nve"); }),
              "LAMMPS: Fix command before simulation box is defined");
    lammps.command("units si");  // it is still usable
}

// Only the first rank notices, so that others would wait.
TEST(Library, ErrorsOfOneRankToo) {
    Library lammps(MPI_COMM_SELF);
    const std::string text = refusal([&] { lammps.command("read_restart /nowhere"); });
    EXPECT_NE(text.find("LAMMPS on this rank: Cannot open restart file /nowhere"),
              std::string::npos)
        << text;
}

TEST(Library, TellsItsRelease) {
    EXPECT_GT(Library(MPI_COMM_SELF).version(), 20000000);
}

}  // namespace
}  // namespace turbidite::lammps
