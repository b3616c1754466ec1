// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls inside the box, from a CSV file (`domain.walls_file`; in space space_walls.hpp):
//
//     id,x1,y1,x2,y2[,thickness][,vx,vy][,spin][,px,py][,friction][,motion]
//
// Each is a plate from (x1, y1) to (x2, y2) that holds grains on both sides, thin unless it has a
// thickness: then it is all that is nearer to the line than half of it, with round ends. It follows
// a prescribed motion: its pivot moves at (vx, vy), and it turns about the pivot. Lengths in D,
// velocities in u_c, spin in 1/t_c; at rest, pivot in the middle and contact.friction unless given.
// A long plate that moves along itself acts as a belt. Other motions are defined below
// domain.motions and named in the column motion.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/scene/space_walls.hpp"
#include "launcher/case/grains/population.hpp"
#include "launcher/case/scales.hpp"

namespace turbidite {

constexpr double shortest_wall = 1e-6;           // [D]
constexpr double full_turn = 6.283185307179586;  // [rad]

/// What a wall in space is, and how it moves (space_walls.hpp).
struct SpaceForm : SpaceWallShape {  // [D]
    Vec3 velocity{};                 ///< [u_c]
    Vec3 spin{};                     ///< [1/t_c]
    Vec3 pivot{};                    ///< [D]
    std::string material = {};       ///< empty: that of the touching grain, with `friction`
};

struct InnerWall {
    GrainId id = 0;
    Point2 from{}, to{};             ///< [D]
    double thickness = 0.0;          ///< [D]
    Point2 velocity{};               ///< [u_c]
    double spin = 0.0;               ///< [1/t_c]
    std::optional<Point2> pivot;     ///< [D]
    std::optional<double> friction;  ///< mu
    std::string motion = {};         ///< name below domain.motions; empty: velocity and spin
    std::optional<SpaceForm> space;  ///< in space, in the place of the plane's members

    /// Whether it has a velocity or spin without a motion.
    bool moves_itself() const;
};

struct InnerWalls {
    std::vector<InnerWall> walls;
    std::vector<CaseProblem> problems;
};

/// In the plane.
InnerWalls read_walls_csv(const std::filesystem::path& file);

/// In the plane. Writes every column; reading it back gives the same walls.
std::string walls_csv(const std::vector<InnerWall>& walls);

/// Reports a wall whose images across cyclic sides would lie on the wall itself, at the start or on
/// the way of one that turns: `turn` is a direction times the largest angle [rad].
std::vector<CaseProblem> check_period(const InnerWall& wall, const Vec3& turn,
                                      const PackingBox& box, const std::string& source);

/// Reports grains that a wall, in the plane or its image across cyclic sides, cuts at the start by
/// more than `tolerance` [D], and walls without a motion that are longer than the period.
std::vector<CaseProblem> check_walls(const std::vector<InnerWall>& walls, const Packing& grains,
                                     const GrainForms& forms, const PackingBox& box,
                                     const std::string& source,
                                     double tolerance = touching_tolerance);

/// Reports walls that are too thin for the cells of the fluid that they reach at the start, where
/// rows are stretched upwards too (coupler/shapes/tight_wall.hpp). The fluid refuses those that
/// move to where they are too thin.
std::vector<CaseProblem> check_thickness(const std::vector<InnerWall>& walls,
                                         const std::string& source, const Settings& settings);

/// The value of `run.walls` in the plane: walls separated by `;`, each
/// `id x1 y1 x2 y2 vx vy spin px py friction thickness` in the run's units.
std::string walls_setting(const std::vector<InnerWall>& walls, const Scales& scales,
                          double friction);

}  // namespace turbidite
