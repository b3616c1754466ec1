// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/grain_forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/shapes/shape.hpp"

namespace turbidite {
namespace {

constexpr double disc_radius = 0.5;       // [D]
constexpr double triangle_radius = 0.75;  // [D]

std::vector<double> flat(const std::vector<Point2>& points) {
    std::vector<double> numbers;
    for (const Point2& point : points) numbers.insert(numbers.end(), point.begin(), point.end());
    return numbers;
}

void note_changes(const Outline& outline, std::vector<std::string>& notes) {
    if (outline.turned_round)
        notes.push_back("grains.vertices are clockwise; their order was reversed");
    if (std::hypot(outline.centre[0], outline.centre[1]) > 1e-9 ||
        std::abs(outline.radius - 1.0) > 1e-9)
        notes.push_back(fmt::format(
            "grains.vertices were moved by ({:.6g}, {:.6g}) to the centre of mass and divided by "
            "{:.6g}, so that the circumscribed radius is 1",
            -outline.centre[0], -outline.centre[1], outline.radius));
}

ShapeRecord record_of(const std::string& kind, const Settings& settings,
                      std::vector<std::string>& notes) {
    if (kind == "triangle") return {kind, equilateral_triangle()};
    if (kind != "polygon") return {kind, {}};
    const Outline outline =
        normalised_outline(real_list("grains.vertices", settings.text("grains.vertices")));
    note_changes(outline, notes);
    return {kind, flat(outline.vertices)};
}

GrainForm form_of(ShapeRecord record) {
    const double radius = record.kind == "triangle" ? triangle_radius : disc_radius;
    std::vector<Point2> outline = make_shape(record)->outline();
    return {std::move(record), std::move(outline), radius};
}

}  // namespace

std::int32_t GrainForms::index_of(const std::string& kind) const {
    for (std::size_t i = 0; i < forms.size(); ++i)
        if (forms[i].record.kind == kind) return static_cast<std::int32_t>(i);
    return -1;
}

GrainForms plain_discs() {
    return {{form_of({"disc", {}})}, {}, 2};
}

GrainForms plain_spheres() {
    return {{form_of({"sphere", {}})}, {}, 3};
}

GrainForms make_grain_forms(const Settings& settings) {
    GrainForms result;
    result.dimension = in_space(settings) ? 3 : 2;
    std::vector<std::string> kinds{settings.text("grains.shape")};
    for (const ShapeEntry& entry : shape_list())
        if (entry.kind != kinds[0] && entry.dimension == result.dimension &&
            (entry.kind != "polygon" || settings.has("grains.vertices")))
            kinds.push_back(entry.kind);
    for (const std::string& kind : kinds)
        result.forms.push_back(form_of(record_of(kind, settings, result.notes)));
    if (settings.has("grains.radius")) result.forms[0].radius = settings.real("grains.radius");
    return result;
}

std::string outline_fault(const std::vector<double>& vertices) {
    try {
        normalised_outline(vertices);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

PlacedOutline placed_outline(const PlacedGrain& grain, const GrainForms& forms) {
    return placed(forms.forms[static_cast<std::size_t>(grain.shape)].outline, {grain.x, grain.y},
                  grain.radius, grain.angle);
}

double least_width(const PlacedGrain& grain, const GrainForms& forms) {
    const auto& outline = forms.forms[static_cast<std::size_t>(grain.shape)].outline;
    if (outline.empty()) return 2.0 * grain.radius;
    // One of the lines lies along an edge.
    double least = 2.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const auto [x, y] = outline[k];
        const auto [next_x, next_y] = outline[(k + 1) % outline.size()];
        const double along_x = next_x - x, along_y = next_y - y;
        double across = 0.0;
        for (const auto& [other_x, other_y] : outline)
            across = std::max(across, std::abs(along_x * (other_y - y) - along_y * (other_x - x)));
        least = std::min(least, across / std::hypot(along_x, along_y));
    }
    return grain.radius * least;
}

double mean_diameter(const PlacedGrain& grain, const GrainForms& forms) {
    const auto& outline = forms.forms[static_cast<std::size_t>(grain.shape)].outline;
    if (outline.empty()) return 2.0 * grain.radius;
    double circumference = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const auto [x, y] = outline[k];
        const auto [next_x, next_y] = outline[(k + 1) % outline.size()];
        circumference += std::hypot(next_x - x, next_y - y);
    }
    return grain.radius * 4.0 * area_moments(outline).area / circumference;
}

ShapeTable used_shapes(Packing& grains, const GrainForms& forms) {
    std::vector<std::int32_t> place(forms.forms.size(), -1);
    for (const PlacedGrain& grain : grains) place[static_cast<std::size_t>(grain.shape)] = 0;
    ShapeTable table;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] < 0) continue;
        // Only shapes that occur are sent: a program must know all in the table (hello.cpp).
        place[i] = static_cast<std::int32_t>(table.size());
        table.push_back(forms.forms[i].record);
    }
    for (PlacedGrain& grain : grains) grain.shape = place[static_cast<std::size_t>(grain.shape)];
    return table;
}

}  // namespace turbidite
