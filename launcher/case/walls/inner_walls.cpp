// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/walls/inner_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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

/// How far the images of a wall are that may reach grains in the box, the wall itself included.
std::vector<Point2> image_shifts(const InnerWall& wall, const PackingBox& box) {
    const auto most = [](bool periodic, double from, double to, double length) {
        // Ends may lie outside the box by several periods: as many images bring them back.
        return periodic ? 1 + static_cast<int>(std::max(std::abs(from), std::abs(to)) / length) : 0;
    };
    const int across = most(box.periodic_x, wall.from[0], wall.to[0], box.width);
    const int up = most(box.periodic_y, wall.from[1], wall.to[1], box.height);
    std::vector<Point2> shifts;
    for (int i = -across; i <= across; ++i)
        for (int j = -up; j <= up; ++j) shifts.push_back({i * box.width, j * box.height});
    return shifts;
}

Point2 middle(const InnerWall& wall) {
    return {0.5 * (wall.from[0] + wall.to[0]), 0.5 * (wall.from[1] + wall.to[1])};
}

std::vector<PlacedOutline> images(const InnerWall& wall, const PackingBox& box) {
    const auto sum = [](const Point2& p, const Point2& q) {
        return Point2{p[0] + q[0], p[1] + q[1]};
    };
    std::vector<PlacedOutline> plates;
    for (const Point2& shift : image_shifts(wall, box))
        plates.push_back(
            {sum(middle(wall), shift), 0.0, {sum(wall.from, shift), sum(wall.to, shift)}});
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
        if (!wall.space) plates_ = images(wall, box);
    }
    double operator()(const PlacedGrain& grain) const {
        if (wall_.space) return surface_gap(wall_, grain);
        // A plate is all that is nearer to its line than half its thickness.
        return smallest_gap(plates_, placed_outline(grain, forms_)) - 0.5 * wall_.thickness;
    }

 private:
    const InnerWall& wall_;
    const GrainForms& forms_;
    std::vector<PlacedOutline> plates_;
};

std::string place_of(const PlacedGrain& grain, bool space) {
    return space ? fmt::format("({}, {}, {})", grain.x, grain.y, grain.z)
                 : fmt::format("({}, {})", grain.x, grain.y);
}

/// Nothing unless the images of a wall in space across a cyclic side would lie on the wall itself.
void check_period(const InnerWall& wall, const PackingBox& box, const std::string& source,
                  std::vector<CaseProblem>& problems) {
    const Vec3 size = size_of(wall), period{box.width, box.height, box.depth};
    const bool repeats[] = {box.periodic_x, box.periodic_y, box.periodic_z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (repeats[axis] && size[axis] > period[axis] + touching_tolerance)
            problems.push_back(
                {.source = source,
                 .line = 0,
                 .key = {},
                 .value = {},
                 .fault = fmt::format("wall {} is {:.6g} D long along {}", wall.id, size[axis],
                                      "xyz"[axis]),
                 .allowed = fmt::format("The box repeats there every {:.6g} D, and the wall with "
                                        "it.",
                                        period[axis]),
                 .remedy = "Let it end at the sides, where its image begins."});
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
    const bool with_friction = std::all_of(walls.begin(), walls.end(),
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
        if (with_friction) text += fmt::format(",{}", *wall.friction);
        text += with_motion ? "," + wall.motion + "\n" : "\n";
    }
    return text;
}

std::vector<CaseProblem> check_walls(const std::vector<InnerWall>& walls, const Packing& grains,
                                     const GrainForms& forms, const PackingBox& box,
                                     const std::string& source, double tolerance) {
    std::vector<CaseProblem> problems;
    for (const InnerWall& wall : walls) {
        if (wall.space) check_period(wall, box, source, problems);
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
                                         const std::string& source, double cell) {
    std::vector<CaseProblem> problems;
    const double least = least_cells_of_plate * cell;
    for (const InnerWall& wall : walls)
        // Exactly two cells are enough, to rounding.
        if (wall.thickness < least * (1.0 - 1e-12))
            problems.push_back(
                {.source = source,
                 .line = 0,
                 .key = {},
                 .value = {},
                 .fault = fmt::format("wall {}: thickness = {:.4g} D", wall.id, wall.thickness),
                 .allowed = fmt::format("The fluid would pass through it: at least {:.0f} cells, "
                                        "here {:.4g} D.",
                                        least_cells_of_plate, least),
                 .remedy = "Give a column thickness, or use more fluid.cells_per_diameter."});
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
