// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/walls/inner_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "coupler/keys/key_value.hpp"
#include "coupler/keys/limit_text.hpp"
#include "coupler/shapes/tight_wall.hpp"
#include "launcher/case/files/csv_table.hpp"
#include "launcher/case/walls/space_walls.hpp"

namespace turbidite {
namespace {

constexpr std::size_t most_problems = 10;  // a wall through a packing cuts many grains

const CsvForm& csv_form() {
    static const CsvForm form = {
        {"id", "x1", "y1", "x2", "y2", "thickness", "vx", "vy", "spin", "px", "py", "friction",
         "motion"},
        {"id", "x1", "y1", "x2", "y2"},
        "The first line must read "
        "id,x1,y1,x2,y2[,thickness][,vx,vy][,spin][,px,py][,friction][,motion]; "
        "lengths in D, "
        "velocities in u_c, spin in 1/t_c.",
        "wall"};
    return form;
}

/// The member that a column sets.
double* number_of(InnerWall& wall, const std::string& column) {
    const std::map<std::string, double*> numbers = {
        {"x1", &wall.from[0]}, {"y1", &wall.from[1]},         {"x2", &wall.to[0]},
        {"y2", &wall.to[1]},   {"vx", &wall.velocity[0]},     {"vy", &wall.velocity[1]},
        {"spin", &wall.spin},  {"thickness", &wall.thickness}};
    if (const auto at = numbers.find(column); at != numbers.end()) return at->second;
    if (column == "friction") return &wall.friction.emplace();
    if (!wall.pivot) wall.pivot.emplace();
    return &(*wall.pivot)[column == "px" ? 0 : 1];
}

void check_wall(CsvTable& table, int line, const InnerWall& wall) {
    const double length = std::hypot(wall.to[0] - wall.from[0], wall.to[1] - wall.from[1]);
    if (!(length > shortest_wall))
        table.refuse(line, fmt::format("wall {} has length {:.4g}", wall.id, length),
                     "Its ends must be apart.", "Move one of them.");
    if (!(wall.thickness >= 0.0))
        table.refuse(line, fmt::format("wall {}: thickness = {}", wall.id, wall.thickness),
                     "A thickness must be zero or positive.", "Use 0 for a thin plate.");
    if (wall.friction && !(*wall.friction >= 0.0))
        table.refuse(line, fmt::format("wall {}: friction = {}", wall.id, *wall.friction),
                     "A friction coefficient must be zero or positive.",
                     "Use 0 for a smooth wall.");
}

InnerWall wall_of(CsvTable& table, const CsvTable::Row& row) {
    InnerWall wall;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const std::string &column = table.columns[i], &text = row.fields[i];
        if (column == "id") {
            wall.id = whole_number(table, row.line, column, text).value_or(0);
            continue;
        }
        if (column == "motion") {
            wall.motion = text;
            continue;
        }
        // An empty field has what a file without the column has.
        if (text.empty() && (column == "friction" || column == "thickness")) continue;
        const auto number = finite_number(table, row.line, column, text, "Give a number.");
        *number_of(wall, column) = number.value_or(0.0);
    }
    return wall;
}

/// Columns that are valid only together.
void check_together(CsvTable& table, const char* one, const char* other) {
    const auto& columns = table.columns;
    const auto has = [&](const char* name) {
        return std::find(columns.begin(), columns.end(), name) != columns.end();
    };
    if (has(one) == has(other)) return;
    table.refuse(1, fmt::format("of the columns {} and {} only one is given", one, other),
                 csv_form().sentence, "Add the other.");
}

Point2 middle(const InnerWall& wall) {
    return {0.5 * (wall.from[0] + wall.to[0]), 0.5 * (wall.from[1] + wall.to[1])};
}

Vec3 centre_of(const InnerWall& wall) {
    if (wall.space) return middle_of(*wall.space);
    return {middle(wall)[0], middle(wall)[1], 0.0};
}

/// Of the faces of a wall: of a plate in the plane, half its thickness to both sides of its line.
Vec3 extent_of(const InnerWall& wall) {
    if (wall.space) return size_of(wall);
    const double x = std::abs(wall.to[0] - wall.from[0]), y = std::abs(wall.to[1] - wall.from[1]);
    const double face = wall.thickness / std::hypot(x, y);
    return {x + face * y, y + face * x, 0.0};
}

WallSurface surface_of(const InnerWall& wall) {
    if (wall.space) return surface_of(*wall.space);
    return surface_of_plate({wall.from[0], wall.from[1], 0.0}, {wall.to[0], wall.to[1], 0.0});
}

/// Equal ones where the case has no box or mesh, which others refuse [D].
MeshRows rows_of(const Settings& settings) {
    MeshRows equal;
    equal.height = 1.0 / settings.real("fluid.cells_per_diameter");
    if (!settings.has("domain.size")) return equal;
    const auto size = real_list("domain.size", settings.text("domain.size"));
    return mesh_rows(settings, size.at(1)).value_or(equal);
}

/// Of the box, and where it repeats.
struct Period {
    double length;
    bool repeats;
};

std::array<Period, 3> periods_of(const PackingBox& box) {
    return {
        {{box.width, box.periodic_x}, {box.height, box.periodic_y}, {box.depth, box.periodic_z}}};
}

/// How far the images of a wall are that may reach grains in the box, the wall itself included.
std::vector<Vec3> image_shifts(const InnerWall& wall, const PackingBox& box) {
    const Vec3 centre = centre_of(wall), size = extent_of(wall);
    std::vector<Vec3> shifts{Vec3{}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [period, repeats] = periods_of(box)[axis];
        if (!repeats) continue;
        // Walls may lie outside the box by several periods. All images that come within a period of
        // it: low + k L <= 2 L and high + k L >= -L.
        const double low = centre[axis] - 0.5 * size[axis], high = centre[axis] + 0.5 * size[axis];
        const int first = static_cast<int>(std::ceil(-1.0 - high / period));
        const int last = static_cast<int>(std::floor(2.0 - low / period));
        std::vector<Vec3> more;
        for (const Vec3& shift : shifts)
            for (int k = first; k <= last; ++k) {
                more.push_back(shift);
                more.back()[axis] = k * period;
            }
        shifts = std::move(more);
    }
    return shifts;
}

std::vector<PlacedOutline> images(const InnerWall& wall, const PackingBox& box) {
    const auto moved = [](const Point2& p, const Vec3& shift) {
        return Point2{p[0] + shift[0], p[1] + shift[1]};
    };
    std::vector<PlacedOutline> plates;
    for (const Vec3& shift : image_shifts(wall, box))
        plates.push_back(
            {moved(middle(wall), shift), 0.0, {moved(wall.from, shift), moved(wall.to, shift)}});
    return plates;
}

double smallest_gap(const std::vector<PlacedOutline>& plates, const PlacedOutline& grain) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const PlacedOutline& plate : plates)
        smallest = std::min(smallest, surface_gap(plate, grain));
    return smallest;
}

/// Of a wall and a grain, at the start.
class StartGap {
 public:
    StartGap(const InnerWall& wall, const GrainForms& forms, const PackingBox& box)
        : wall_(wall), forms_(forms) {
        if (wall.space)
            shifts_ = image_shifts(wall, box);
        else
            plates_ = images(wall, box);
    }
    double operator()(const PlacedGrain& grain) const {
        if (wall_.space) return gap_in_space(grain);
        // A plate is all that is nearer to its line than half its thickness.
        return smallest_gap(plates_, placed_outline(grain, forms_)) - 0.5 * wall_.thickness;
    }

 private:
    double gap_in_space(const PlacedGrain& sphere) const {
        double smallest = std::numeric_limits<double>::infinity();
        for (const Vec3& shift : shifts_)
            smallest = std::min(
                smallest,
                surface_gap(wall_, Vec3{sphere.x, sphere.y, sphere.z} - shift, sphere.radius));
        return smallest;
    }

    const InnerWall& wall_;
    const GrainForms& forms_;
    std::vector<PlacedOutline> plates_;  ///< in the plane
    std::vector<Vec3> shifts_;           ///< in space
};

std::string place_of(const PlacedGrain& grain, bool space) {
    return space ? fmt::format("({}, {}, {})", grain.x, grain.y, grain.z)
                 : fmt::format("({}, {})", grain.x, grain.y);
}

/// A round wall that turns about its own axis stays where it is.
bool turns_in_itself(const SpaceForm& form, const Vec3& turn) {
    return form.kind != SpaceWallKind::plate &&
           norm(cross(form.a, turn)) < 1e-9 * norm(form.a) * norm(turn);
}

/// The extent along an axis, the largest on the way of a wall that turns.
double longest_extent(const InnerWall& wall, const Vec3& turn, std::size_t axis) {
    const Vec3 size = extent_of(wall);
    if (turn == Vec3{} || (wall.space && turns_in_itself(*wall.space, turn))) return size[axis];
    const auto is_along = [&](std::size_t k) { return std::abs(turn[k]) == norm(turn); };
    if (is_along(axis)) return size[axis];
    Vec3 others = size;
    others[axis] = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        if (is_along(k)) others[k] = 0.0;
    // Of a box that turns by an angle t: size cos(t) + others sin(t), which grows up to its
    // diagonal.
    const double angle = std::min(norm(turn), std::atan2(norm(others), size[axis]));
    return size[axis] * std::cos(angle) + norm(others) * std::sin(angle);
}

/// Without a motion: any angle, about its spin.
Vec3 own_turn(const InnerWall& wall) {
    const Vec3 spin = wall.space ? wall.space->spin : Vec3{0, 0, wall.spin};
    return spin == Vec3{} ? spin : full_turn * (spin / norm(spin));
}

}  // namespace

bool InnerWall::moves_itself() const {
    if (space) return space->velocity != Vec3{} || space->spin != Vec3{};
    return velocity != Point2{} || spin != 0.0;
}

InnerWalls read_walls_csv(const std::filesystem::path& file) {
    CsvTable table = read_csv(file, csv_form());
    if (!table.columns.empty()) {
        check_together(table, "vx", "vy");
        check_together(table, "px", "py");
    }
    InnerWalls result;
    std::map<GrainId, int> first;
    for (const CsvTable::Row& row : table.rows) {
        const std::size_t before = table.problems.size();
        const InnerWall wall = wall_of(table, row);
        if (table.problems.size() == before) check_wall(table, row.line, wall);
        if (const auto [at, fresh] = first.emplace(wall.id, row.line); !fresh)
            table.refuse(row.line, fmt::format("wall id {} is given twice", wall.id),
                         fmt::format("It is already in line {}.", at->second),
                         "Renumber one of them.");
        result.walls.push_back(wall);
    }
    result.problems = std::move(table.problems);
    return result;
}

std::string walls_csv(const std::vector<InnerWall>& walls) {
    const bool with_friction = std::any_of(walls.begin(), walls.end(),
                                           [](const InnerWall& w) { return bool(w.friction); });
    std::string text = "id,x1,y1,x2,y2,thickness,vx,vy,spin,px,py";
    const bool with_motion = std::any_of(walls.begin(), walls.end(),
                                         [](const InnerWall& w) { return !w.motion.empty(); });
    if (with_friction) text += ",friction";
    text += with_motion ? ",motion\n" : "\n";
    for (const InnerWall& wall : walls) {
        const Point2 pivot = wall.pivot.value_or(middle(wall));
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}", wall.id, wall.from[0], wall.from[1],
                            wall.to[0], wall.to[1], wall.thickness, wall.velocity[0],
                            wall.velocity[1], wall.spin, pivot[0], pivot[1]);
        if (with_friction) text += wall.friction ? fmt::format(",{}", *wall.friction) : ",";
        text += with_motion ? "," + wall.motion + "\n" : "\n";
    }
    return text;
}

CaseProblems check_period(const InnerWall& wall, const Vec3& turn, const PackingBox& box,
                          const std::string& source) {
    CaseProblems problems;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [period, repeats] = periods_of(box)[axis];
        const double size = longest_extent(wall, turn, axis);
        if (repeats && size > period + touching_tolerance)
            problems.push_back(
                {.source = source,
                 .line = 0,
                 .key = {},
                 .value = {},
                 .fault =
                     fmt::format("wall {} is {:.6g} D long along {}{}", wall.id, size, "xyz"[axis],
                                 size > extent_of(wall)[axis] ? " when it has turned" : ""),
                 .allowed = fmt::format("The box repeats there every {:.6g} D, and the wall with "
                                        "it.",
                                        period),
                 .remedy = "Let it end at the sides, where its image begins."});
    }
    return problems;
}

std::vector<CaseProblem> check_walls(const std::vector<InnerWall>& walls, const Packing& grains,
                                     const GrainForms& forms, const PackingBox& box,
                                     const std::string& source, double tolerance) {
    std::vector<CaseProblem> problems;
    for (const InnerWall& wall : walls) {
        if (wall.motion.empty()) append(problems, check_period(wall, own_turn(wall), box, source));
        const StartGap gap_of(wall, forms, box);
        for (const PlacedGrain& grain : grains) {
            const double gap = gap_of(grain);
            if (gap >= -tolerance || problems.size() >= most_problems) continue;
            problems.push_back(
                {.source = source,
                 .line = 0,
                 .key = {},
                 .value = {},
                 .fault = fmt::format("wall {} cuts grain {} at {} by {:.4g} D", wall.id, grain.id,
                                      place_of(grain, wall.space.has_value()), -gap),
                 .allowed = "Grains may touch a wall but not overlap with it.",
                 .remedy = "Move the wall or the grain."});
        }
    }
    return problems;
}

std::vector<CaseProblem> check_thickness(const std::vector<InnerWall>& walls,
                                         const std::string& source, const Settings& settings) {
    std::vector<CaseProblem> problems;
    const MeshRows rows = rows_of(settings);
    for (const InnerWall& wall : walls) {
        const double least = least_thickness(surface_of(wall), wall.thickness, rows);
        if (is_too_thin(wall.thickness, least))
            problems.push_back(
                {.source = source,
                 .line = 0,
                 .key = {},
                 .value = {},
                 .fault = fmt::format("wall {}: thickness = {:.4g} D", wall.id, wall.thickness),
                 .allowed = fmt::format("The fluid would pass through it: at least {:.0f} cells, "
                                        "here {} D.",
                                        least_cells_of_wall, at_least_text(least, 4)),
                 .remedy = least > least_cells_of_wall * rows.height
                               ? "Give a column thickness, or use a larger fluid.stretch_from."
                               : "Give a column thickness, or use more "
                                 "fluid.cells_per_diameter."});
    }
    return problems;
}

std::string walls_setting(const std::vector<InnerWall>& walls, const Scales& scales,
                          double friction) {
    const double d = scales.diameter, u = scales.velocity;
    std::string text;
    for (const InnerWall& wall : walls) {
        const Point2 pivot = wall.pivot.value_or(middle(wall));
        // The twelve numbers of coupler/protocol/scene/plates.hpp.
        text += fmt::format("{}{} {} {} {} {} {} {} {} {} {} {} {}", text.empty() ? "" : ";",
                            wall.id, wall.from[0] * d, wall.from[1] * d, wall.to[0] * d,
                            wall.to[1] * d, wall.velocity[0] * u, wall.velocity[1] * u,
                            wall.spin / scales.time, pivot[0] * d, pivot[1] * d,
                            wall.friction.value_or(friction), wall.thickness * d);
    }
    return text;
}

}  // namespace turbidite
