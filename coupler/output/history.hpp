// SPDX-License-Identifier: LGPL-2.1-or-later
//
// history.csv: one row per output interval, dimensionless with D, u_c, t_c. The columns are one
// table (history_columns.cpp); other tools rely on their names and order. Quantities that do not
// apply are empty.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>

#include "coupler/output/measures/contact_network.hpp"
#include "coupler/output/measures/run_statistics.hpp"
#include "coupler/shapes/immersed_bodies.hpp"

namespace turbidite {

/// The data of a row.
struct Row {
    std::int64_t step = 0;  ///< number of windows done
    double time = 0.0;      ///< t^{n+1} [s]
    const Motion* state = nullptr;
    const ContactReport* contact = nullptr;  ///< null before the first window
    const FluidReport* fluid = nullptr;      ///< null in dry runs and before the first window
    Vec3 fluid_force{};                      ///< sum of F_h over the grains [N]
    const JointReport* joint = nullptr;      ///< null under other schemes
    std::optional<SinceRow> since;           ///< empty before the first window
    std::optional<double> grain_balance;     ///< GrainBalance::defect
    std::optional<double> motion_defect;     ///< MotionDefect::defect [m]
};

/// Means over the grains, in run units.
struct Averages {
    Vec3 velocity{};
    Vec3 position{};
    double speed = 0.0;
    double front = 0.0;           ///< max (x + R) of the grains still in the box
    double kinetic_energy = 0.0;  ///< sum of (m U^2 + I w^2)/2 [J]
    double height = 0.0;          ///< sum of (M - m_f) y over sum of m [m]
    double mass = 0.0;            ///< sum of m [kg]
    double solid = 0.0;           ///< sum of V [m2, in space m3]
};
Averages averages(const Motion& state, const ImmersedBodies& bodies);

/// A row and the quantities derived for it.
struct RowValues {
    const Row& row;
    Averages mean;
    double pores;                           ///< pore_volume [m2, in space m3]
    std::optional<ContactNetwork> network;  ///< empty unless contacts were sent
    const RunValues& run;
};

/// The header line.
std::string history_header();

/// The line of a row, without the newline.
std::string history_line(const RowValues& values);

class History {
 public:
    /// Creates the file with its header. Throws Failure when it cannot be written.
    History(const std::filesystem::path& file, const RunValues& run, const ShapeTable& shapes);

    /// Goes on with the file of an earlier part of the run, after its first `length` bytes.
    History(const std::filesystem::path& file, const RunValues& run, const ShapeTable& shapes,
            std::int64_t length);

    const std::filesystem::path& file() const { return file_; }
    std::int64_t length() { return out_.tellp(); }  ///< bytes written so far

    /// Throws Failure when the disk is full.
    void append(const Row& row);

 private:
    RowValues values(const Row& row) const;
    double pores(const Motion& state) const;

    std::filesystem::path file_;
    std::ofstream out_;
    ImmersedBodies bodies_;
    RunValues run_;
};

}  // namespace turbidite
