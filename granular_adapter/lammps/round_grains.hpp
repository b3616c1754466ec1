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
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::lammps {

/// Columns of d2_own.
enum Own {
    load_x,  ///< loads of the window [N], [N m]
    load_y,
    load_turn_z,
    impulse_x,  ///< sum over the sub-steps of delta times all forces but gravity [N s], [N m s]
    impulse_y,
    impulse_turn_z,
    angle,        ///< about z, in the plane [rad]
    turn_factor,  ///< c m R^2/I, as LAMMPS turns discs with c = 1/2 and spheres with c = 2/5
    id_high,      ///< the 64 bits of the id in two halves; LAMMPS' own numbers have 31 bits
    id_low,
    plane_columns,
    // Only in space:
    load_z = plane_columns,
    load_turn_x,
    load_turn_y,
    impulse_z,
    impulse_turn_x,
    impulse_turn_y,
    orientation,  ///< four columns, a unit quaternion
    space_columns = orientation + 4
};

/// The axes along which grains are pushed and about which they turn, and their columns.
struct Freedom {
    int pushes, turns;  ///< how many of the axes below
    int turn_axis[3] = {2, 0, 1};
    Own load[3] = {load_x, load_y, load_z}, load_turn[3] = {load_turn_x, load_turn_y, load_turn_z};
    Own impulse[3] = {impulse_x, impulse_y, impulse_z};
    Own impulse_turn[3] = {impulse_turn_x, impulse_turn_y, impulse_turn_z};

    explicit constexpr Freedom(int dimension) : pushes(dimension), turns(dimension == 3 ? 3 : 1) {}

    /// visit(axis)
    template <class Visit>
    void each_push(Visit visit) const {
        for (int axis = 0; axis < pushes; ++axis) visit(axis);
    }
    template <class Visit>
    void each_turn(Visit visit) const {
        for (int k = 0; k < turns; ++k) visit(turn_axis[k]);
    }
};

class RoundGrains {
 public:
    /// `dimension`: 2 for discs, 3 for spheres.
    RoundGrains(Library& lammps, int dimension, const nscd::PeriodicBox& period)
        : lammps_(lammps), dimension_(dimension), period_(period) {}

    /// The LAMMPS command for the arrays above.
    static std::string declaration(int dimension);

    Freedom freedom() const { return Freedom(dimension_); }
    bool in_space() const { return dimension_ == 3; }

    /// Turns a grain with these columns of Own by its spin [rad/s] over a time [s].
    void turn(double* own, const double* spin, double time) const;

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

    /// The centre of a grain by its index into LAMMPS' arrays, also of a copy, as it lies in the
    /// box that repeats: LAMMPS lets grains run beyond a side until it sorts them anew.
    Vec3 centre(int index) const;

    /// The id of a grain of this rank, or of another rank's grain that is copied here, by its index
    /// into LAMMPS' arrays.
    GrainId id(int index) const;

 private:
    struct Newcomer;
    Newcomer newcomer(const nscd::Bodies& bodies, std::size_t i, const MassClasses& classes) const;
    Quaternion orientation_of(const double* own) const;
    void set_orientation(double* own, const Quaternion& q) const;
    void take(const std::vector<Newcomer>& newcomers, int giver, int first_tag);

    Library& lammps_;
    int dimension_;
    nscd::PeriodicBox period_;
};

}  // namespace turbidite::lammps
