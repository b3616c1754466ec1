// SPDX-License-Identifier: GPL-2.0-or-later
//
// LAMMPS has one stiffness per pair of atom types, and one per group at a wall, while all contacts
// are to last equally long, k = m_r w^2 with the reduced mass m_r of the pair. So grains of one
// mass are one type. If there are more masses than types, types are classes of equal width in log
// m, and k belongs to the middle of the class: w is wrong by at most half the width of a class,
// (m_max/m_min)^(1/(4 K)) - 1 for K classes, 2 % for masses 1 to 4.
#pragma once

#include <mpi.h>

#include <vector>

namespace turbidite::lammps {

class MassClasses {
 public:
    /// LAMMPS allows 32 groups of atoms, of which each class takes one.
    static constexpr std::size_t most = 16;

    /// Of the masses of all ranks [kg]; collective.
    MassClasses(const std::vector<double>& masses, MPI_Comm communicator);

    /// Mass that stands for each class, ascending; one entry at least.
    const std::vector<double>& masses() const { return masses_; }

    /// Class of a mass, counted from 1 as LAMMPS counts types.
    int type_of(double mass) const;

 private:
    std::vector<double> masses_;
};

}  // namespace turbidite::lammps
