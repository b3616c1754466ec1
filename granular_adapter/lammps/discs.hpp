// SPDX-License-Identifier: GPL-2.0-or-later
//
// The grains in LAMMPS' arrays, in whatever order and on whatever rank LAMMPS keeps them. Beside
// its own quantities each grain carries what the host needs about it:
//
//     i_from_rank, i_from_place    its Origin (migration.hpp)
//     d2_own                       the columns of Own
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "granular_adapter/lammps/lammps_library.hpp"
#include "granular_adapter/lammps/mass_classes.hpp"
#include "granular_adapter/lammps/migration.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"

namespace turbidite::lammps {

/// Columns of d2_own.
enum Own {
    load_x,  ///< loads of the window [N], [N m]
    load_y,
    load_turn,
    impulse_x,  ///< sum over the sub-steps of delta times all forces but gravity [N s], [N m s]
    impulse_y,
    impulse_turn,
    angle,        ///< about z [rad]
    turn_factor,  ///< (m R^2/2)/I, as LAMMPS turns discs with the moment m R^2/2
    id_high,      ///< the 64 bits of the id in two halves; LAMMPS' own numbers have 31 bits
    id_low,
    own_columns
};

class Discs {
 public:
    explicit Discs(Library& lammps) : lammps_(lammps) {}

    /// The LAMMPS command for the arrays above.
    static std::string declaration();

    /// Creates the bodies of all ranks, each on the rank that owns its place; collective.
    void create(const nscd::Bodies& bodies, const MassClasses& classes, MPI_Comm communicator);

    /// Between these two, `place` is the one in i_from_place.
    void read(nscd::Bodies& bodies) const;
    void write(const nscd::Bodies& bodies);

    /// Where the grains of this rank were when they were last numbered, in LAMMPS' order.
    std::vector<Origin> origins() const;

    /// Numbers them anew: their places in `order`, on this rank.
    void number(const std::vector<Origin>& order, int rank);

    /// Removes grains of any rank by LAMMPS' numbers, the same list on all; collective. Places are
    /// left as they were.
    void remove(const std::vector<std::int64_t>& tags);

    /// Calls visit(place, index into LAMMPS' arrays) for each grain of this rank.
    template <class Visit>
    void for_each(Visit visit) const {
        const int* place = lammps_.atoms<int*>("i_from_place");
        for (int i = 0, count = lammps_.local_count(); i < count; ++i)
            visit(static_cast<std::size_t>(place[i]), i);
    }

    /// The id of a grain of this rank, or of another rank's grain that is copied here, by its index
    /// into LAMMPS' arrays.
    GrainId id(int index) const;

 private:
    struct Newcomer;
    static Newcomer newcomer(const nscd::Bodies& bodies, std::size_t i, const MassClasses& classes);
    void take(const std::vector<Newcomer>& newcomers, int giver, int first_tag);

    Library& lammps_;
};

}  // namespace turbidite::lammps
