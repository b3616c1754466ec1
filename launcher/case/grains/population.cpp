// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/population.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "launcher/case/files/csv_table.hpp"
#include "launcher/case/grains/packing/neighbour_grid.hpp"

namespace turbidite {
namespace {

// A packing with errors everywhere should not scroll the first one off the screen.
constexpr std::size_t most_problems_of_a_kind = 10;

/// The meaning of the words in a grains file.
struct FileWords {
    const GrainForms& forms;
    const std::vector<std::string>& materials;
    const std::vector<std::string>& motions;
};

const CsvForm& space_form() {
    static const CsvForm form = {
        {"id", "x", "y", "z", "radius", "shape", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx",
         "wy", "wz", "density", "material", "motion"},
        {"id", "x", "y", "z"},
        "In space the first line must read id,x,y,z[,radius][,shape][,qw,qx,qy,qz][,vx][,vy][,vz]"
        "[,wx][,wy][,wz][,density][,material][,motion], lengths in D, velocities in u_c, spins in "
        "1/t_c.",
        "grain"};
    return form;
}

const CsvForm& csv_form(int dimension) {
    if (dimension == 3) return space_form();
    static const CsvForm form = {
        {"id", "x", "y", "z", "radius", "shape", "angle", "vx", "vy", "spin", "density", "material",
         "motion"},
        {"id", "x", "y"},
        "The first line must read id,x,y[,z][,radius][,shape][,angle][,vx][,vy][,spin][,density]"
        "[,material][,motion], lengths in D, angles in rad, velocities in u_c, spin in 1/t_c.",
        "grain"};
    return form;
}

std::string known_kinds(const GrainForms& forms) {
    std::string names;
    for (const GrainForm& form : forms.forms)
        names += (names.empty() ? "" : ", ") + form.record.kind;
    return names;
}

void set_shape(CsvTable& table, int line, const GrainForms& forms, const std::string& text,
               PlacedGrain& grain) {
    const std::int32_t index = forms.index_of(text);
    if (index >= 0)
        grain.shape = index;
    else
        table.refuse(line, fmt::format("shape = {}", text),
                     fmt::format("Known here: {}.", known_kinds(forms)),
                     text == "polygon" ? "Define it with grains.vertices." : "Use one of them.");
}

void set_material(CsvTable& table, int line, const std::vector<std::string>& materials,
                  const std::string& text, PlacedGrain& grain) {
    const auto at = std::find(materials.begin(), materials.end(), text);
    if (at != materials.end())
        grain.material = static_cast<std::int32_t>(at - materials.begin());
    else
        table.refuse(line, fmt::format("material = {}", text),
                     fmt::format("Known here: {}.", fmt::join(materials, ", ")),
                     "Describe it below contact.materials, or correct the name.");
}

void set_motion(CsvTable& table, int line, const std::vector<std::string>& motions,
                const std::string& text, PlacedGrain& grain) {
    const bool free = text == "free";
    grain.prescribed = !free;
    if (free || text == "fixed" || text == "driven") return;
    grain.motion = text;
    if (std::find(motions.begin(), motions.end(), text) == motions.end())
        table.refuse(
            line, fmt::format("motion = {}", text),
            fmt::format("free grains move under forces, fixed ones do not move, driven "
                        "ones keep vx, vy and spin, others follow a motion of "
                        "domain.motions; there are {}.",
                        motions.empty() ? "none" : fmt::format("{}", fmt::join(motions, ", "))),
            "Use one of these.");
}

const char* field_remedy(const std::string& column) {
    if (column == "angle") return "Give the angle in radians.";
    if (column == "vx" || column == "vy" || column == "vz") return "Give the velocity in u_c.";
    if (column == "spin" || column[0] == 'w') return "Give the spin in 1/t_c.";
    if (column[0] == 'q') return "Give the parts w, x, y, z of a unit quaternion.";
    if (column == "density") return "Give the density over that of the fluid.";
    return "Give the length in grain diameters.";
}

/// The member that a column of space sets.
void set_in_space(const std::string& column, double number, PlacedGrain& grain) {
    const std::pair<const char*, double*> members[] = {
        {"x", &grain.x},        {"y", &grain.y},          {"z", &grain.z},
        {"vx", &grain.vx},      {"vy", &grain.vy},        {"vz", &grain.vz},
        {"wx", &grain.wx},      {"wy", &grain.wy},        {"wz", &grain.spin},
        {"qw", &grain.turn[0]}, {"qx", &grain.turn[1]},   {"qy", &grain.turn[2]},
        {"qz", &grain.turn[3]}, {"radius", &grain.radius}};
    for (const auto& [name, member] : members)
        if (column == name) *member = number;
    if (column == "density") grain.density = number;
}

/// A quaternion to the digits of a file is made a unit one; others are refused.
void check_turn(CsvTable& table, int line, PlacedGrain& grain) {
    double square = 0.0;
    for (const double part : grain.turn) square += part * part;
    // |q|^2, so up to 5e-4 in the length: four digits in the file are enough.
    if (std::abs(square - 1.0) > 1e-3) {
        table.refuse(line,
                     fmt::format("grain {}: ({}) is no unit quaternion", grain.id,
                                 fmt::join(grain.turn, ", ")),
                     "qw, qx, qy, qz have the sum of squares 1; (1, 0, 0, 0) is not turned.",
                     "Divide them by their length, or leave all four out.");
        return;
    }
    // One of the digits of a double stays as it is: it is read again by `resume`.
    if (std::abs(square - 1.0) > 1e-15)
        for (double& part : grain.turn) part /= std::sqrt(square);
}

/// An empty field, as pandas writes a missing one, has what a file without the column has.
bool may_be_empty(const std::string& column) {
    return column == "shape" || column == "material" || column == "motion" || column == "radius" ||
           column == "density";
}

void set_field(CsvTable& table, int line, const FileWords& words, const std::string& column,
               const std::string& text, PlacedGrain& grain) {
    if (text.empty() && may_be_empty(column)) return;
    if (column == "shape") return set_shape(table, line, words.forms, text, grain);
    if (column == "material") return set_material(table, line, words.materials, text, grain);
    if (column == "motion") return set_motion(table, line, words.motions, text, grain);
    if (column == "id") {
        grain.id = whole_number(table, line, column, text).value_or(0);
        return;
    }
    const auto number = finite_number(table, line, column, text, field_remedy(column));
    if (!number) return;
    if (words.forms.dimension == 3) return set_in_space(column, *number, grain);
    if (column == "z" && *number != 0.0)
        table.refuse(line, fmt::format("z = {}", text), "In two dimensions z is 0.",
                     "Set it to 0 or remove the column.");
    if (column == "x") grain.x = *number;
    if (column == "y") grain.y = *number;
    if (column == "angle") grain.angle = *number;
    if (column == "radius") grain.radius = *number;
    if (column == "vx") grain.vx = *number;
    if (column == "vy") grain.vy = *number;
    if (column == "spin") grain.spin = *number;
    if (column == "density") grain.density = *number;
}

bool has_motion(const PlacedGrain& grain) {
    return grain.vx != 0.0 || grain.vy != 0.0 || grain.vz != 0.0 || grain.wx != 0.0 ||
           grain.wy != 0.0 || grain.spin != 0.0;
}

/// A fixed grain is one whose prescribed velocity is zero; that of a motion is not given here.
void check_fixed(CsvTable& table, const CsvTable::Row& row, const PlacedGrain& grain) {
    const bool has_velocity = has_motion(grain);
    if (!grain.motion.empty() && has_velocity)
        table.refuse(
            row.line,
            fmt::format("grain {} follows motion {} and has a velocity", grain.id, grain.motion),
            "vx, vy and spin of a grain that follows a motion are 0.", "Set them to 0.");
    if (table.field(row, "motion") == "fixed" && has_velocity)
        table.refuse(row.line, fmt::format("grain {} is fixed and has a velocity", grain.id),
                     "vx, vy and spin of a fixed grain are 0.",
                     "Set them to 0, or use motion = driven.");
}

PlacedGrain grain_of(CsvTable& table, const CsvTable::Row& row, const FileWords& words) {
    const GrainForms& forms = words.forms;
    PlacedGrain grain;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        set_field(table, row.line, words, table.columns[i], row.fields[i], grain);
    if (forms.dimension == 3) check_turn(table, row.line, grain);
    check_fixed(table, row, grain);
    if (table.field(row, "radius").empty())
        // Only now, since the default follows from the shape, which may be a later column.
        grain.radius = forms.forms[static_cast<std::size_t>(grain.shape)].radius;
    return grain;
}

/// Adds problems up to a largest number; `finish` reports how many were left out.
class Collector {
 public:
    Collector(std::vector<CaseProblem>& problems, const PopulationSource& source)
        : problems_(problems), source_(source) {}

    void add(std::size_t index, const std::string& fault, const std::string& allowed,
             const std::string& remedy) {
        if (++count_ > most_problems_of_a_kind) return;
        const int line = index < source_.lines.size() ? source_.lines[index] : 0;
        problems_.push_back(problem_at(source_.name, line, fault, allowed, remedy));
    }

    void finish(const std::string& kind) {
        if (count_ <= most_problems_of_a_kind) return;
        problems_.back().remedy +=
            fmt::format(" ({} more {} not shown.)", count_ - most_problems_of_a_kind, kind);
    }

 private:
    std::vector<CaseProblem>& problems_;
    const PopulationSource& source_;
    std::size_t count_ = 0;
};

void check_ids(const Packing& grains, Collector problems) {
    std::map<GrainId, std::size_t> first;
    for (std::size_t i = 0; i < grains.size(); ++i)
        if (!first.emplace(grains[i].id, i).second)
            problems.add(i, fmt::format("grain id {} is given twice", grains[i].id),
                         "Every grain has its own id.", "Renumber one of them.");
    problems.finish("repeated ids");
}

void check_radii(const Packing& grains, Collector problems) {
    for (std::size_t i = 0; i < grains.size(); ++i)
        if (!(grains[i].radius > 0.0))
            problems.add(i, fmt::format("grain {}: radius = {}", grains[i].id, grains[i].radius),
                         "A radius must be positive (0.5 D is the default).",
                         "Correct it or remove the grain.");
    problems.finish("bad radii");
}

void check_densities(const Packing& grains, Collector problems) {
    for (std::size_t i = 0; i < grains.size(); ++i)
        if (grains[i].density && !(*grains[i].density > 0.0))
            problems.add(i, fmt::format("grain {}: density = {}", grains[i].id, *grains[i].density),
                         "The density ratio must be above 0.",
                         "Correct it, or leave the column out for grains.density_ratio.");
    problems.finish("bad densities");
}

struct Excess {
    const char* side;
    double beyond;  // >= 0 if outside [D]
};

/// How far a grain reaches from its centre towards each side of the box [D].
std::array<double, 6> extents_of(const PlacedGrain& grain, const GrainForms& forms) {
    if (forms.dimension == 3) {
        std::array<double, 6> extents{};
        extents.fill(grain.radius);
        return extents;
    }
    // From +x, -x, +y, -y to the order of box_sides.
    const auto [right, left, up, down] = reach(placed_outline(grain, forms));
    return {left, right, down, up};
}

std::string place_text(const PlacedGrain& grain, const GrainForms& forms) {
    return forms.dimension == 3 ? fmt::format("({}, {}, {})", grain.x, grain.y, grain.z)
                                : fmt::format("({}, {})", grain.x, grain.y);
}

std::string size_text(const PackingBox& box) {
    return box.in_space() ? fmt::format("{} x {} x {}", box.width, box.height, box.depth)
                          : fmt::format("{} x {}", box.width, box.height);
}

Excess worst_side(const PlacedGrain& grain, const PackingBox& box, const SolidSides& walls,
                  const GrainForms& forms) {
    const std::array<double, 6> extents = extents_of(grain, forms);
    const double place[] = {grain.x, grain.y, grain.z};
    const double size[] = {box.width, box.height, box.depth};
    Excess worst{"", -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < side_count(forms.dimension); ++i) {
        const auto& [name, key, axis, inward] = box_sides[i];
        // Whole grains stay inside of walls; at free and cyclic sides only their centres.
        const double margin = walls.solid[i] ? extents[i] : 0.0;
        const double beyond =
            inward > 0.0 ? margin - place[axis] : place[axis] + margin - size[axis];
        // The farthest one: a grain in a corner is told once.
        if (beyond > worst.beyond) worst = {name, beyond};
    }
    return worst;
}

void check_inside(const Packing& grains, const PackingBox& box, const SolidSides& walls,
                  const GrainForms& forms, double tolerance, Collector problems) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Excess worst = worst_side(grains[i], box, walls, forms);
        if (worst.beyond > tolerance)
            problems.add(
                i,
                fmt::format("grain {} at {} is outside the box: {:.4g} D beyond its "
                            "{} side",
                            grains[i].id, place_text(grains[i], forms), worst.beyond, worst.side),
                fmt::format("The box is {} D.", size_text(box)),
                "Move the grain or enlarge domain.size.");
    }
    problems.finish("grains outside");
}

double median_radius(const Packing& grains) {
    std::vector<double> radii;
    for (const PlacedGrain& grain : grains) radii.push_back(grain.radius);
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
}

/// Finds which of the grains so far may touch a further one. Grains far above the median radius
/// stand outside the grid, whose cells would otherwise hold thousands of the small ones.
class GrainsSoFar {
 public:
    GrainsSoFar(const Packing& grains, const PackingBox& box, const GrainForms& forms)
        : grains_(grains),
          most_(4.0 * median_radius(grains)),
          // Cells of 2 R_max of those in the grid (NeighbourGrid); pairs with a large one are
          // looked at one by one.
          grid_(box, std::min(largest_radius(grains), most_), 0.0, &forms) {}

    const NeighbourGrid& geometry() const { return grid_; }

    void add(std::size_t index) {
        if (is_large(index)) return large_.push_back(index);
        grid_.insert(grains_[index]);
        in_grid_.push_back(index);
    }

    /// Ascending.
    std::vector<std::size_t> near(std::size_t index) const {
        std::vector<std::size_t> found = large_;
        if (is_large(index)) {
            found.insert(found.end(), in_grid_.begin(), in_grid_.end());
        } else {
            const PlacedGrain& grain = grains_[index];
            for (const std::size_t other : grid_.near(grain.x, grain.y, grain.z))
                found.push_back(in_grid_[other]);
        }
        std::sort(found.begin(), found.end());
        return found;
    }

 private:
    bool is_large(std::size_t index) const { return grains_[index].radius > most_; }

    const Packing& grains_;
    double most_ = 0.0;  ///< radius of the grains in the grid [D]
    NeighbourGrid grid_;
    std::vector<std::size_t> in_grid_, large_;
};

void check_overlaps(const Packing& grains, const PackingBox& box, const GrainForms& forms,
                    double tolerance, Collector problems) {
    if (grains.empty() || largest_radius(grains) <= 0.0) return;
    GrainsSoFar so_far(grains, box, forms);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        for (const std::size_t j : so_far.near(i)) {
            // Circumscribed circles that are apart settle it; outlines cost more.
            if (so_far.geometry().circle_gap(grains[i], grains[j]) >= -tolerance) continue;
            const double gap = so_far.geometry().gap(grains[i], grains[j]);
            if (gap < -tolerance)
                problems.add(i,
                             fmt::format("grains {} and {} overlap by {:.4g} D", grains[j].id,
                                         grains[i].id, -gap),
                             "Grains may touch but not overlap by more than grains.overlap.",
                             "Move one of them.");
        }
        // After its own check: each pair is looked at once.
        so_far.add(i);
    }
    problems.finish("overlaps");
}

}  // namespace

PopulationFile read_population_csv(const std::filesystem::path& file, const GrainForms& forms,
                                   const std::vector<std::string>& materials,
                                   const std::vector<std::string>& motions) {
    CsvTable table = read_csv(file, csv_form(forms.dimension));
    PopulationFile result;
    result.source.name = table.name;
    for (const CsvTable::Row& row : table.rows) {
        const std::size_t before = table.problems.size();
        const PlacedGrain grain = grain_of(table, row, {forms, materials, motions});
        if (table.problems.size() > before) continue;  // what is unreadable would be checked as 0
        result.grains.push_back(grain);
        result.source.lines.push_back(row.line);
    }
    result.problems = std::move(table.problems);
    std::stable_sort(result.problems.begin(), result.problems.end(),
                     [](const CaseProblem& a, const CaseProblem& b) { return a.line < b.line; });
    return result;
}

namespace {

/// Columns that are written only if a grain has such a value.
struct OptionalColumns {
    const char* header;
    bool (*needed)(const PlacedGrain&, const GrainForms&);
    std::string (*text)(const PlacedGrain&, const FileWords&);
};

const std::string& kind_of(const PlacedGrain& grain, const GrainForms& forms) {
    return forms.forms[static_cast<std::size_t>(grain.shape)].record.kind;
}

bool is_turned(const PlacedGrain& grain, const GrainForms& forms) {
    const bool round = forms.forms[static_cast<std::size_t>(grain.shape)].outline.empty();
    return !round || grain.angle != 0.0;
}

bool moves(const PlacedGrain& grain, const GrainForms&) {
    return has_motion(grain);
}

bool is_turned_in_space(const PlacedGrain& grain, const GrainForms&) {
    return grain.turn != Quaternion{1.0, 0.0, 0.0, 0.0};
}

std::string motion_of(const PlacedGrain& grain) {
    if (!grain.prescribed) return "free";
    if (!grain.motion.empty()) return grain.motion;
    // Both keep their velocity; a fixed one has none.
    return moves(grain, plain_discs()) ? "driven" : "fixed";
}

/// How a grain is turned and how it moves, in the plane and in space.
const std::vector<OptionalColumns> planar_columns = {
    {",shape,angle", is_turned,
     [](const PlacedGrain& g, const FileWords& words) {
         return fmt::format(",{},{}", kind_of(g, words.forms), g.angle);
     }},
    {",vx,vy,spin", moves,
     [](const PlacedGrain& g, const FileWords&) {
         return fmt::format(",{},{},{}", g.vx, g.vy, g.spin);
     }},
};
const std::vector<OptionalColumns> space_columns = {
    {",qw,qx,qy,qz", is_turned_in_space,
     [](const PlacedGrain& g, const FileWords&) {
         return fmt::format(",{}", fmt::join(g.turn, ","));
     }},
    {",vx,vy,vz,wx,wy,wz", moves,
     [](const PlacedGrain& g, const FileWords&) {
         return fmt::format(",{},{},{},{},{},{}", g.vx, g.vy, g.vz, g.wx, g.wy, g.spin);
     }},
};
const std::vector<OptionalColumns> common_columns = {
    {",density", [](const PlacedGrain& g, const GrainForms&) { return g.density.has_value(); },
     // Those without one have grains.density_ratio, as for the reader.
     [](const PlacedGrain& g, const FileWords&) {
         return g.density ? fmt::format(",{}", *g.density) : ",";
     }},
    {",material", [](const PlacedGrain& g, const GrainForms&) { return g.material != 0; },
     [](const PlacedGrain& g, const FileWords& words) {
         return "," + words.materials.at(static_cast<std::size_t>(g.material));
     }},
    {",motion", [](const PlacedGrain& g, const GrainForms&) { return g.prescribed; },
     [](const PlacedGrain& g, const FileWords&) { return "," + motion_of(g); }},
};

}  // namespace

std::string population_csv(const Packing& grains, const GrainForms& forms,
                           const std::vector<std::string>& materials) {
    const bool space = forms.dimension == 3;
    std::vector<const OptionalColumns*> columns;
    for (const auto* part : {space ? &space_columns : &planar_columns, &common_columns})
        for (const OptionalColumns& column : *part)
            if (std::any_of(grains.begin(), grains.end(),
                            [&](const PlacedGrain& grain) { return column.needed(grain, forms); }))
                columns.push_back(&column);
    std::string text = space ? "id,x,y,z,radius" : "id,x,y,radius";
    for (const OptionalColumns* column : columns) text += column->header;
    text += "\n";
    for (const PlacedGrain& grain : grains) {
        text += fmt::format("{},{},{},", grain.id, grain.x, grain.y);
        text +=
            space ? fmt::format("{},{}", grain.z, grain.radius) : fmt::format("{}", grain.radius);
        for (const OptionalColumns* column : columns)
            text += column->text(grain, {forms, materials, {}});
        text += "\n";
    }
    return text;
}

std::vector<CaseProblem> check_population(const Packing& grains, const PopulationSource& source,
                                          const PackingBox& box, const SolidSides& walls,
                                          const GrainForms& forms, double overlap) {
    const double tolerance = std::max(overlap, touching_tolerance);
    std::vector<CaseProblem> problems;
    check_ids(grains, {problems, source});
    check_radii(grains, {problems, source});
    check_densities(grains, {problems, source});
    check_inside(grains, box, walls, forms, tolerance, {problems, source});
    check_overlaps(grains, box, forms, tolerance, {problems, source});
    return problems;
}

}  // namespace turbidite
