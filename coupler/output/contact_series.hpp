// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contacts as a ParaView series, for force chains: grains/contacts.pvd and one file of lines
// per output. Apply Tube with "Vary Radius: by scalar", scalar `normal_force`. The files are
// created at the first output that has contacts.
//
// A line joins the centres of the two grains, or the contact point at a wall and the centre of the
// grain; across a cyclic side it ends at the nearest image. The second grain's centre is that of
// grains.pvd, at t^{n+1}; all other values are those at which the contact was solved.
#pragma once

#include <filesystem>
#include <optional>

#include "coupler/output/vtk_files.hpp"
#include "coupler/protocol/records.hpp"

namespace turbidite {

class ContactSeries {
 public:
    /// In the folder of the series.
    static constexpr const char* collection_name = "contacts.pvd";

    explicit ContactSeries(std::filesystem::path folder, int dimension = 2)
        : folder_(std::move(folder)), dimension_(dimension) {}

    /// Goes on with the series of an earlier part of the run.
    void resume(std::int64_t length);

    /// Null before the first contacts.
    vtk::Collection* collection() { return collection_ ? &*collection_ : nullptr; }

    /// One line per contact point, in run units, with
    ///
    ///     id_a, id_b           id_a = -1 - wall at a wall: 0 left, 1 right, 2 bottom, 3 top, ...,
    ///                          in space 4 front, 5 back
    ///     feature              which of the pair's points
    ///     normal_force         along the normal from a to b; positive: repulsive
    ///     tangential_force     on b, along the normal turned by +90 degrees; in space its size
    ///     rolling_moment       on b; in space the size of what is across the normal
    ///     torsion_moment       on b, in space: along the normal
    ///     force                on b
    ///     normal, point, gap
    ///     status               bits: 1 sliding, 2 rolling, 4 a film between surfaces that do not
    ///                          touch; 0 sticking
    ///
    /// per cell, and also normal_force per point. `step` is the time over which the impulses acted.
    /// Writes nothing if the state carries no contacts. Throws Failure when the disk is full.
    void write(double time, std::int64_t window, double step, const Motion& state);

 private:
    void write_lines(const std::string& name, double step, const Motion& state) const;

    std::filesystem::path folder_;
    int dimension_ = 2;
    std::optional<vtk::Collection> collection_;
};

}  // namespace turbidite
