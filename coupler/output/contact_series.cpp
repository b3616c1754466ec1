// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/contact_series.hpp"

#include "coupler/protocol/grain_index.hpp"
#include "coupler/rigid/vec3.hpp"

namespace turbidite {
namespace {

/// t = e_z x n.
Vec3 tangent(const ContactRecord& contact) {
    return {-contact.normal[1], contact.normal[0], 0.0};
}

/// Of the part of a vector across a contact's normal.
double size_across(const Vec3& vector, const ContactRecord& contact) {
    return norm(vector - dot(vector, contact.normal) * contact.normal);
}

GrainId first_id(const ContactRecord& contact) {
    // Walls are -1, -2, ...: ids of grains are not negative.
    return contact.wall < 0 ? contact.a : -1 - contact.wall;
}

/// Two points per contact, from a to b.
std::vector<Vec3> line_ends(const Motion& state) {
    const GrainIndex index(state.grains);
    std::vector<Vec3> ends;
    ends.reserve(2 * state.contacts->size());
    for (const ContactRecord& contact : *state.contacts) {
        const Vec3& centre = state.grains.at(index.place(contact.b)).position;
        // At a wall the contact point; across a cyclic side the nearest image of a, outside the
        // box.
        ends.push_back(centre - contact.branch);
        ends.push_back(centre);
    }
    return ends;
}

}  // namespace

void ContactSeries::resume(std::int64_t length) {
    collection_.emplace(folder_ / collection_name, length);
}

void ContactSeries::write(double time, std::int64_t window, double step, const Motion& state) {
    if (!state.contacts) return;
    const std::string name = fmt::format("contacts_{:08d}.vtp", window);
    write_lines(name, step, state);
    // The first contacts that are sent: programs that send none leave no empty series.
    if (!collection_) collection_.emplace(folder_ / collection_name);
    collection_->add(time, {name});
}

void ContactSeries::write_lines(const std::string& name, double step, const Motion& state) const {
    using Contact = const ContactRecord&;
    const auto& contacts = *state.contacts;
    const std::vector<Vec3> ends = line_ends(state);
    const auto along = [&](Contact c, const Vec3& axis) { return dot(c.impulse, axis) / step; };
    const bool space = dimension_ == 3;
    const auto normal_force = [&](Contact c) { return along(c, c.normal); };
    const vtk::PieceSize size{.points = ends.size(), .lines = contacts.size()};
    vtk::write_poly_data(folder_ / name, size, [&](std::ostream& out) {
        out << "<Points>\n";
        vtk::vectors(out, "position", ends, [](const Vec3& end) { return end; });
        out << "</Points>\n<Lines>\n";
        vtk::consecutive_cells(out, std::vector<std::size_t>(contacts.size(), 2));
        out << "</Lines>\n<PointData Scalars=\"normal_force\">\n";
        vtk::data_array(out, "type=\"Float64\" Name=\"normal_force\"", contacts, [&](Contact c) {
            const std::string text = vtk::scalar(normal_force(c));
            return text + text;
        });
        out << "</PointData>\n<CellData Scalars=\"normal_force\" Vectors=\"force\">\n";
        vtk::integers(out, "id_a", contacts, first_id);
        vtk::integers(out, "id_b", contacts, [](Contact c) { return c.b; });
        vtk::integers(out, "feature", contacts, [](Contact c) { return c.feature; });
        vtk::scalars(out, "normal_force", contacts, normal_force);
        vtk::scalars(out, "tangential_force", contacts, [&](Contact c) {
            // In the plane with a sign, in space the size of the part across the normal.
            return space ? size_across(c.impulse, c) / step : along(c, tangent(c));
        });
        vtk::scalars(out, "rolling_moment", contacts, [&](Contact c) {
            return (space ? size_across(c.rolling_impulse, c) : c.rolling_impulse[2]) / step;
        });
        if (space)
            vtk::scalars(out, "torsion_moment", contacts,
                         [&](Contact c) { return dot(c.rolling_impulse, c.normal) / step; });
        vtk::vectors(out, "force", contacts, [&](Contact c) { return 1.0 / step * c.impulse; });
        vtk::vectors(out, "normal", contacts, [](Contact c) { return c.normal; });
        vtk::vectors(out, "point", contacts, [](Contact c) { return c.point; });
        vtk::scalars(out, "gap", contacts, [](Contact c) { return c.gap; });
        vtk::integers(out, "status", contacts, [](Contact c) { return c.status; });
        out << "</CellData>\n";
    });
}

}  // namespace turbidite
