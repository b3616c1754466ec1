// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contacts as a ParaView series: grains/contacts.pvd over one file of lines per output, for
// force chains. Apply Tube with "Vary Radius: by scalar", scalar `normal_force`. The files are made
// at the first output that has contacts.
//
// A line joins the centres of the two grains, or the contact point at a wall and the centre of the
// grain; across a cyclic side it ends at the nearest image. The second grain's centre is the one of
// grains.pvd, at t^{n+1}; everything else is as the contact was solved.
#pragma once

#include <filesystem>
#include <optional>

#include "coupler/output/vtk_files.hpp"
#include "coupler/protocol/records.hpp"

namespace turbidite {

class ContactSeries {
 public:
    explicit ContactSeries(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// One line per contact point, in run units, with
    ///
    ///     id_a, id_b         ids; id_a = -1 - wall at a wall (0 left, 1 right, 2 bottom, 3 top,
    ///     ...) feature            which of the pair's points normal_force       along the normal
    ///     from a to b, positive: they push apart tangential_force   along the normal turned by +90
    ///     degrees, on b rolling_moment     on b force              on b normal, point, gap status
    ///     bits: 1 sliding, 2 rolling; 0 sticks
    ///
    /// per cell, and normal_force per point as well. `step` is the time that the impulses took.
    /// Writes nothing when the state tells no contacts. Throws Failure when the disk is full.
    void write(double time, std::int64_t window, double step, const Motion& state);

 private:
    void write_lines(const std::string& name, double step, const Motion& state) const;

    std::filesystem::path folder_;
    std::optional<vtk::Collection> collection_;
};

}  // namespace turbidite
