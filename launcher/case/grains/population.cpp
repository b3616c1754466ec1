// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/population.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "launcher/case/files/csv_table.hpp"
#include "launcher/case/grains/neighbour_grid.hpp"

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

const CsvForm& csv_form() {
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
    grain.prescribed = text != "free";
    if (text == "free" || text == "fixed" || text == "driven") return;
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
    if (column == "vx" || column == "vy") return "Give the velocity in u_c.";
    if (column == "spin") return "Give the spin in 1/t_c.";
    if (column == "density") return "Give the density over that of the fluid.";
    return "Give the length in grain diameters.";
}

void set_field(CsvTable& table, int line, const FileWords& words, const std::string& column,
               const std::string& text, PlacedGrain& grain) {
    if (column == "shape") return set_shape(table, line, words.forms, text, grain);
    if (column == "material") return set_material(table, line, words.materials, text, grain);
    if (column == "motion") return set_motion(table, line, words.motions, text, grain);
    if (column == "id") {
        grain.id = whole_number(table, line, column, text).value_or(0);
        return;
    }
    const auto number = finite_number(table, line, column, text, field_remedy(column));
    if (!number) return;
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

/// A fixed grain is one whose prescribed velocity is zero; that of a motion is not given here.
void check_fixed(CsvTable& table, const CsvTable::Row& row, const PlacedGrain& grain) {
    const bool has_velocity = grain.vx != 0.0 || grain.vy != 0.0 || grain.spin != 0.0;
    if (!grain.motion.empty() && has_velocity)
        table.refuse(
            row.line,
            fmt::format("grain {} follows motion {} and has a velocity", grain.id, grain.motion),
            "vx, vy and spin of a grain that follows a motion are 0.", "Set them to 0.");
    const auto column = std::find(table.columns.begin(), table.columns.end(), "motion");
    if (column == table.columns.end()) return;
    const bool fixed =
        row.fields[static_cast<std::size_t>(column - table.columns.begin())] == "fixed";
    if (fixed && has_velocity)
        table.refuse(row.line, fmt::format("grain {} is fixed and has a velocity", grain.id),
                     "vx, vy and spin of a fixed grain are 0.",
                     "Set them to 0, or use motion = driven.");
}

PlacedGrain grain_of(CsvTable& table, const CsvTable::Row& row, const FileWords& words) {
    const GrainForms& forms = words.forms;
    PlacedGrain grain;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        set_field(table, row.line, words, table.columns[i], row.fields[i], grain);
    check_fixed(table, row, grain);
    const auto& columns = table.columns;
    if (std::find(columns.begin(), columns.end(), "radius") == columns.end())
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

Excess worst_side(const PlacedGrain& grain, const PackingBox& box, const SolidSides& walls,
                  const GrainForms& forms) {
    const auto [right, left, up, down] = reach(placed_outline(grain, forms));
    const double extents[] = {left, right, down, up};
    const double place[] = {grain.x, grain.y}, size[] = {box.width, box.height};
    Excess worst{"", -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < box_sides.size(); ++i) {
        const auto& [name, key, axis, inward] = box_sides[i];
        const double margin = walls.solid[i] ? extents[i] : 0.0;
        const double beyond =
            inward > 0.0 ? margin - place[axis] : place[axis] + margin - size[axis];
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
                fmt::format("grain {} at ({}, {}) is outside the box: {:.4g} D beyond its "
                            "{} side",
                            grains[i].id, grains[i].x, grains[i].y, worst.beyond, worst.side),
                fmt::format("The box is {} x {} D.", box.width, box.height),
                "Move the grain or enlarge domain.size.");
    }
    problems.finish("grains outside");
}

void check_overlaps(const Packing& grains, const PackingBox& box, const GrainForms& forms,
                    double tolerance, Collector problems) {
    const double largest = largest_radius(grains);
    if (largest <= 0.0) return;
    NeighbourGrid grid(box, largest, 0.0, &forms);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        for (const std::size_t j : grid.near(grains[i].x, grains[i].y)) {
            if (grid.circle_gap(grains[i], grains[j]) >= -tolerance) continue;
            const double gap = grid.gap(grains[i], grains[j]);
            if (gap < -tolerance)
                problems.add(i,
                             fmt::format("grains {} and {} overlap by {:.4g} D", grains[j].id,
                                         grains[i].id, -gap),
                             "Grains may touch but not overlap by more than grains.overlap.",
                             "Move one of them.");
        }
        grid.insert(grains[i]);
    }
    problems.finish("overlaps");
}

}  // namespace

PopulationFile read_population_csv(const std::filesystem::path& file, const GrainForms& forms,
                                   const std::vector<std::string>& materials,
                                   const std::vector<std::string>& motions) {
    CsvTable table = read_csv(file, csv_form());
    PopulationFile result;
    result.source.name = table.name;
    for (const CsvTable::Row& row : table.rows) {
        result.grains.push_back(grain_of(table, row, {forms, materials, motions}));
        result.source.lines.push_back(row.line);
    }
    result.problems = std::move(table.problems);
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
    return grain.vx != 0.0 || grain.vy != 0.0 || grain.spin != 0.0;
}

std::string motion_of(const PlacedGrain& grain) {
    if (!grain.prescribed) return "free";
    if (!grain.motion.empty()) return grain.motion;
    return moves(grain, plain_discs()) ? "driven" : "fixed";
}

const OptionalColumns optional_columns[] = {
    {",shape,angle", is_turned,
     [](const PlacedGrain& g, const FileWords& words) {
         return fmt::format(",{},{}", kind_of(g, words.forms), g.angle);
     }},
    {",vx,vy,spin", moves,
     [](const PlacedGrain& g, const FileWords&) {
         return fmt::format(",{},{},{}", g.vx, g.vy, g.spin);
     }},
    {",density", [](const PlacedGrain& g, const GrainForms&) { return g.density.has_value(); },
     [](const PlacedGrain& g, const FileWords&) { return fmt::format(",{}", *g.density); }},
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
    std::vector<const OptionalColumns*> columns;
    for (const OptionalColumns& column : optional_columns)
        if (std::any_of(grains.begin(), grains.end(),
                        [&](const PlacedGrain& grain) { return column.needed(grain, forms); }))
            columns.push_back(&column);
    std::string text = "id,x,y,radius";
    for (const OptionalColumns* column : columns) text += column->header;
    text += "\n";
    for (const PlacedGrain& grain : grains) {
        text += fmt::format("{},{},{},{}", grain.id, grain.x, grain.y, grain.radius);
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
