// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "granular_adapter/lammps/round_grains.hpp"

namespace turbidite::lammps {

const char* const loads_fix = "loads";

namespace {

void run_all(Library& lammps, std::initializer_list<std::string> lines) {
    for (const std::string& line : lines) lammps.command(line);
}

/// k = m w^2; LAMMPS multiplies the dashpot's coefficient, 2 zeta w, by the reduced mass.
std::string contact(const SoftLaw& law, double reduced_mass) {
    const double stiffness = reduced_mass * law.frequency * law.frequency;
    // hooke k c, tangential a k, a c, mu: the same ratio a for spring and dashpot.
    return fmt::format(
        "hooke {:.17g} {:.17g} tangential linear_history {:.17g} {:.17g} {:.17g} damping "
        "mass_velocity limit_damping",
        stiffness, 2.0 * law.damping * law.frequency, law.tangential_share * stiffness,
        law.tangential_share, law.friction);
}

void declare_pairs(Library& lammps, const SoftLaw& law, const std::vector<double>& masses) {
    lammps.command("pair_style granular");
    for (std::size_t i = 0; i < masses.size(); ++i)
        for (std::size_t j = i; j < masses.size(); ++j)
            lammps.command(
                fmt::format("pair_coeff {} {} {}", i + 1, j + 1,
                            contact(law, masses[i] * masses[j] / (masses[i] + masses[j]))));
}

struct Plane {
    const char* name;
    std::size_t low, high;  ///< among the borders
};
// Borders are in the order left, right, bottom, top, front, back; in the plane the last two are
// missing.
constexpr Plane planes[] = {{"xplane", 0, 1}, {"yplane", 2, 3}, {"zplane", 4, 5}};

bool has_wall(const Plane& plane, const std::vector<Border>& borders) {
    if (plane.high >= borders.size()) return false;
    return borders[plane.low].side == BorderKind::wall ||
           borders[plane.high].side == BorderKind::wall;
}

std::string fix_name(const Plane& plane, std::size_t type) {
    return fmt::format("{}{}", plane.name, type);
}

std::string place(const Border& border, int axis) {
    return border.side == BorderKind::wall ? fmt::format("{:.17g}", border.plane.point[axis])
                                           : "NULL";
}

void declare_walls(Library& lammps, const SoftLaw& law, const std::vector<double>& masses,
                   const std::vector<Border>& borders) {
    for (std::size_t type = 1; type <= masses.size(); ++type)
        for (int axis = 0; axis < 3; ++axis) {
            const Plane& plane = planes[axis];
            if (!has_wall(plane, borders)) continue;
            // One fix per class of masses: at a wall the spring is that of the grain's own mass.
            lammps.command(fmt::format("fix {} class{} wall/gran granular {} {} {} {} contacts",
                                       fix_name(plane, type), type, contact(law, masses[type - 1]),
                                       plane.name, place(borders[plane.low], axis),
                                       place(borders[plane.high], axis)));
        }
}

}  // namespace

void declare_box(Library& lammps, int dimension, const Vec3& size, const nscd::PeriodicBox& period,
                 const std::vector<Border>& borders, double margin, std::size_t types) {
    const bool in_space = dimension == 3;
    // Boundaries `m` follow grains outwards, `p` repeat; the plane has to repeat along z.
    const auto boundary = [&](int axis) {
        return period.repeats(axis) || (axis == 2 && !in_space) ? 'p' : 'm';
    };
    run_all(lammps, {"units si", fmt::format("dimension {}", dimension),
                     fmt::format("boundary {} {} {}", boundary(0), boundary(1), boundary(2)),
                     "atom_style sphere", strips_along_x});
    const auto beyond = [&](std::size_t side) {
        return borders[side].side == BorderKind::free ? margin : 0.0;
    };
    const auto ends = [&](std::size_t axis) {
        return fmt::format("{:.17g} {:.17g}", -beyond(2 * axis), size[axis] + beyond(2 * axis + 1));
    };
    const double thick = 0.01 * std::max(size[0], size[1]);
    const std::string depth = in_space ? ends(2) : fmt::format("{:.17g} {:.17g}", -thick, thick);
    lammps.command(fmt::format("region domain block {} {} {}", ends(0), ends(1), depth));
    lammps.command(fmt::format("create_box {} domain", types));
}

void declare_properties(Library& lammps, int dimension) {
    run_all(lammps, {"comm_modify vel yes", RoundGrains::declaration(dimension)});
}

void declare_engines(Library& lammps, const Engines& engines) {
    const std::vector<double>& masses = engines.classes.masses();
    for (std::size_t type = 1; type <= masses.size(); ++type)
        lammps.command(fmt::format("group class{0} type {0}", type));
    declare_pairs(lammps, engines.law, masses);
    lammps.command(fmt::format("neighbor {:.17g} bin", engines.skin));
    run_all(lammps,
            // Lists are checked in every sub-step; the strips get equally many grains, to 10 %.
            {"neigh_modify every 1 delay 0 check yes",
             engines.in_space ? "fix motion all nve/sphere" : "fix motion all nve/sphere disc",
             "fix balance all balance 0 1.1 shift x 10 1.05"});
    declare_walls(lammps, engines.law, masses, engines.borders);
    // The last one, so that it finds all contact forces.
    lammps.command(fmt::format("fix {} all external pf/callback 1 1", loads_fix));
    run_all(lammps,
            {"compute pairs all pair/local dist fx fy fz p1 p2 p3 p10 p11 p12 cutoff radius",
             "compute names all property/local patom1 patom2 cutoff radius",
             "thermo_style custom step", "thermo 1000000000"});
}

std::vector<std::string> wall_fixes(const MassClasses& classes,
                                    const std::vector<Border>& borders) {
    std::vector<std::string> names;
    for (std::size_t type = 1; type <= classes.masses().size(); ++type)
        for (const Plane& plane : planes)
            if (has_wall(plane, borders)) names.push_back(fix_name(plane, type));
    return names;
}

}  // namespace turbidite::lammps
