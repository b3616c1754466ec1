// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/mass_classes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace turbidite::lammps {
namespace {

int rank_of_world() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

// Every rank has the same classes, whichever masses it has itself.
TEST(MassClasses, FewMassesAreTheClasses) {
    const double mine = rank_of_world() == 0 ? 2.0 : 3.0;
    const MassClasses classes({mine, 1.0, mine}, MPI_COMM_WORLD);
    EXPECT_EQ(classes.masses().front(), 1.0);
    EXPECT_EQ(classes.masses()[1], 2.0);
    EXPECT_EQ(classes.type_of(1.0), 1);
    EXPECT_EQ(classes.masses()[std::size_t(classes.type_of(mine) - 1)], mine);
}

// Masses 1 to 4: k is wrong by (4)^(1/32) - 1 = 4.4 % at most, so w by 2.2 %.
TEST(MassClasses, ManyMassesShareThem) {
    std::vector<double> masses;
    for (int i = 0; i <= 300; ++i) masses.push_back(1.0 + 0.01 * i);
    const MassClasses classes(masses, MPI_COMM_WORLD);
    ASSERT_EQ(classes.masses().size(), MassClasses::most);
    for (const double mass : masses) {
        const double of_class = classes.masses()[std::size_t(classes.type_of(mass) - 1)];
        EXPECT_LT(std::abs(std::log(mass / of_class)), std::log(4.0) / 32.0 + 1e-12);
    }
}

TEST(MassClasses, ThereIsAlwaysOne) {
    EXPECT_EQ(MassClasses({}, MPI_COMM_WORLD).masses().size(), 1u);
}

}  // namespace
}  // namespace turbidite::lammps
