// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/population.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "launcher/case/csv_table.hpp"
#include "launcher/case/neighbour_grid.hpp"

namespace turbidite {
namespace {

// A packing that is wrong everywhere should not scroll the first error away.
constexpr std::size_t most_problems_of_a_kind = 10;

CaseProblem problem_at(const std::string& source, int line, const std::string& fault,
                       const std::string& allowed, const std::string& remedy) {
    return {.source = source,
            .line = line,
            .key = {},
            .value = {},
            .fault = fault,
            .allowed = allowed,
            .remedy = remedy};
}

const CsvForm& csv_form() {
    static const CsvForm form = {{"id", "x", "y", "z", "radius", "shape", "angle"},
                                 {"id", "x", "y"},
                                 "The first line must read id,x,y[,z][,radius][,shape][,angle], "
                                 "lengths in D, angles in rad.",
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
        table.refuse(
            line, fmt::format("shape = {}", text),
            fmt::format("Known here: {}.", known_kinds(forms)),
            text == "polygon" ? "Say what it is with grains.vertices." : "Use one of them.");
}

void set_field(CsvTable& table, int line, const GrainForms& forms, const std::string& column,
               const std::string& text, PlacedGrain& grain) {
    if (column == "shape") return set_shape(table, line, forms, text, grain);
    if (column == "id") {
        grain.id = whole_number(table, line, column, text).value_or(0);
        return;
    }
    const auto number = finite_number(
        table, line, column, text,
        column == "angle" ? "Give the angle in radians." : "Give the length in grain diameters.");
    if (!number) return;
    if (column == "z" && *number != 0.0)
        table.refuse(line, fmt::format("z = {}", text), "In two dimensions z is 0.",
                     "Set it to 0 or remove the column.");
    if (column == "x") grain.x = *number;
    if (column == "y") grain.y = *number;
    if (column == "angle") grain.angle = *number;
    if (column == "radius") grain.radius = *number;
}

PlacedGrain grain_of(CsvTable& table, const CsvTable::Row& row, const GrainForms& forms) {
    PlacedGrain grain;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        set_field(table, row.line, forms, table.columns[i], row.fields[i], grain);
    const auto& columns = table.columns;
    if (std::find(columns.begin(), columns.end(), "radius") == columns.end())
        grain.radius = forms.forms[static_cast<std::size_t>(grain.shape)].radius;
    return grain;
}

/// Adds to a list up to a number; `finish` says how many were left out.
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

struct Side {
    const char* name;
    double excess;  // how far beyond the side, >= 0 when outside [D]
};

Side worst_side(const PlacedGrain& grain, const PackingBox& box, const SolidSides& walls,
                const GrainForms& forms) {
    const auto [right, left, up, down] = reach(placed_outline(grain, forms));
    const auto margin = [](bool wall, double extent) { return wall ? extent : 0.0; };
    const Side sides[] = {{"left", margin(walls.left, left) - grain.x},
                          {"right", grain.x + margin(walls.right, right) - box.width},
                          {"bottom", margin(walls.bottom, down) - grain.y},
                          {"top", grain.y + margin(walls.top, up) - box.height}};
    return *std::max_element(std::begin(sides), std::end(sides),
                             [](const Side& a, const Side& b) { return a.excess < b.excess; });
}

void check_inside(const Packing& grains, const PackingBox& box, const SolidSides& walls,
                  const GrainForms& forms, Collector problems) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Side side = worst_side(grains[i], box, walls, forms);
        if (side.excess > touching_tolerance)
            problems.add(
                i,
                fmt::format("grain {} at ({}, {}) is outside the box: {:.4g} D beyond its "
                            "{} side",
                            grains[i].id, grains[i].x, grains[i].y, side.excess, side.name),
                fmt::format("The box is {} x {} D.", box.width, box.height),
                "Move the grain or enlarge domain.size.");
    }
    problems.finish("grains outside");
}

void check_overlaps(const Packing& grains, const PackingBox& box, const GrainForms& forms,
                    Collector problems) {
    const double largest = largest_radius(grains);
    if (largest <= 0.0) return;
    NeighbourGrid grid(box, largest, 0.0, &forms);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        for (const std::size_t j : grid.near(grains[i].x, grains[i].y)) {
            if (grid.circle_gap(grains[i], grains[j]) >= -touching_tolerance) continue;
            const double gap = grid.gap(grains[i], grains[j]);
            if (gap < -touching_tolerance)
                problems.add(i,
                             fmt::format("grains {} and {} overlap by {:.4g} D", grains[j].id,
                                         grains[i].id, -gap),
                             "Grains may touch but not overlap.", "Move one of them.");
        }
        grid.insert(grains[i]);
    }
    problems.finish("overlaps");
}

}  // namespace

PopulationFile read_population_csv(const std::filesystem::path& file, const GrainForms& forms) {
    CsvTable table = read_csv(file, csv_form());
    PopulationFile result;
    result.source.name = table.name;
    for (const CsvTable::Row& row : table.rows) {
        result.grains.push_back(grain_of(table, row, forms));
        result.source.lines.push_back(row.line);
    }
    result.problems = std::move(table.problems);
    return result;
}

std::string population_csv(const Packing& grains, const GrainForms& forms) {
    const bool round = std::all_of(grains.begin(), grains.end(), [&](const PlacedGrain& grain) {
        return forms.forms[static_cast<std::size_t>(grain.shape)].outline.empty() &&
               grain.angle == 0.0;
    });
    std::string text = round ? "id,x,y,radius\n" : "id,x,y,radius,shape,angle\n";
    for (const PlacedGrain& grain : grains) {
        text += fmt::format("{},{},{},{}", grain.id, grain.x, grain.y, grain.radius);
        const std::string& kind = forms.forms[static_cast<std::size_t>(grain.shape)].record.kind;
        text += round ? "\n" : fmt::format(",{},{}\n", kind, grain.angle);
    }
    return text;
}

std::vector<CaseProblem> check_population(const Packing& grains, const PopulationSource& source,
                                          const PackingBox& box, const SolidSides& walls,
                                          const GrainForms& forms) {
    std::vector<CaseProblem> problems;
    check_ids(grains, {problems, source});
    check_radii(grains, {problems, source});
    check_inside(grains, box, walls, forms, {problems, source});
    check_overlaps(grains, box, forms, {problems, source});
    return problems;
}

}  // namespace turbidite
