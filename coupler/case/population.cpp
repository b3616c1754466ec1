// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/case/population.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

#include "coupler/case/key_value.hpp"
#include "coupler/case/neighbour_grid.hpp"

namespace turbidite {
namespace {

// A packing that is wrong everywhere should not scroll the first error away.
constexpr std::size_t most_problems_of_a_kind = 10;

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line)
        if (c == ',')
            fields.emplace_back();
        else if (c != ' ' && c != '\t' && c != '\r')
            fields.back() += c;
    return fields;
}

/// A line of a grains file; 0 when there is none.
struct Place {
    std::string source;
    int line;
};

CaseProblem problem_at(const Place& place, const std::string& fault, const std::string& allowed,
                       const std::string& remedy) {
    return {.source = place.source,
            .line = place.line,
            .key = {},
            .value = {},
            .fault = fault,
            .allowed = allowed,
            .remedy = remedy};
}

struct Reader {
    PopulationFile result;
    std::vector<std::string> columns;
    int line = 0;

    void refuse(const std::string& fault, const std::string& allowed, const std::string& remedy) {
        result.problems.push_back(
            problem_at({result.source.name, line}, fault, allowed, remedy));
    }
};

const std::vector<std::string>& known_columns() {
    static const std::vector<std::string> names = {"id", "x", "y", "z", "radius"};
    return names;
}

bool has(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

void read_header(Reader& reader, const std::string& text) {
    constexpr auto form = "The first line must read id,x,y[,z][,radius], lengths in D.";
    reader.columns = split(text);
    for (const std::string& column : reader.columns)
        if (!has(known_columns(), column))
            reader.refuse(fmt::format("column \"{}\" is unknown", column), form,
                          "Rename or remove it.");
        else if (std::count(reader.columns.begin(), reader.columns.end(), column) > 1)
            reader.refuse(fmt::format("column \"{}\" is there more than once", column), form,
                          "Keep one.");
    for (const std::string required : {"id", "x", "y"})
        if (!has(reader.columns, required))
            reader.refuse(fmt::format("column \"{}\" is missing", required), form, "Add it.");
}

void set_field(Reader& reader, PlacedGrain& grain, const std::string& column,
               const std::string& text) {
    if (column == "id") {
        const auto id = parse_integer(text);
        if (!id || *id < 0)
            reader.refuse(fmt::format("id = {}", text), "An id is a whole number, zero or above.",
                          "Number the grains 0, 1, 2, ...");
        grain.id = id.value_or(0);
        return;
    }
    const auto number = parse_real(text);
    if (!number || !std::isfinite(*number))
        return reader.refuse(fmt::format("{} = {}", column, text), "It must be a finite number.",
                             "Give the length in grain diameters.");
    if (column == "z" && *number != 0.0)
        reader.refuse(fmt::format("z = {}", text), "In two dimensions z is 0.",
                      "Set it to 0 or remove the column.");
    if (column == "x") grain.x = *number;
    if (column == "y") grain.y = *number;
    if (column == "radius") grain.radius = *number;
}

void read_row(Reader& reader, const std::string& text) {
    const auto fields = split(text);
    if (fields.size() != reader.columns.size())
        return reader.refuse(fmt::format("{} values in \"{}\"", fields.size(), text),
                             fmt::format("The header names {} columns.", reader.columns.size()),
                             "Give one value per column.");
    PlacedGrain grain;
    for (std::size_t i = 0; i < fields.size(); ++i)
        set_field(reader, grain, reader.columns[i], fields[i]);
    reader.result.grains.push_back(grain);
    reader.result.source.lines.push_back(reader.line);
}

bool is_blank(const std::string& text) {
    return text.find_first_not_of(" \t\r") == std::string::npos || text.front() == '#';
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
        problems_.push_back(problem_at({source_.name, line}, fault, allowed, remedy));
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

Side worst_side(const PlacedGrain& grain, const PackingBox& box, const SolidSides& walls) {
    const auto margin = [&](bool wall) { return wall ? grain.radius : 0.0; };
    const Side sides[] = {{"left", margin(walls.left) - grain.x},
                          {"right", grain.x + margin(walls.right) - box.width},
                          {"bottom", margin(walls.bottom) - grain.y},
                          {"top", grain.y + margin(walls.top) - box.height}};
    return *std::max_element(std::begin(sides), std::end(sides),
                             [](const Side& a, const Side& b) { return a.excess < b.excess; });
}

void check_inside(const Packing& grains, const PackingBox& box, const SolidSides& walls,
                  Collector problems) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Side side = worst_side(grains[i], box, walls);
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

void check_overlaps(const Packing& grains, const PackingBox& box, Collector problems) {
    double largest = 0.0;
    for (const PlacedGrain& grain : grains) largest = std::max(largest, grain.radius);
    if (largest <= 0.0) return;
    NeighbourGrid grid(box, largest, 0.0);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        for (const std::size_t j : grid.near(grains[i].x, grains[i].y)) {
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

PopulationFile read_population_csv(const std::filesystem::path& file) {
    Reader reader;
    reader.result.source.name = file.filename().string();
    std::ifstream input(file);
    if (!input) {
        reader.refuse("cannot be read", "A CSV file of grains is needed.",
                      "Check the path " + file.string() + ".");
        return reader.result;
    }
    std::string text;
    while (std::getline(input, text)) {
        ++reader.line;
        if (is_blank(text)) continue;
        if (reader.columns.empty()) {
            read_header(reader, text);
            if (!reader.result.problems.empty()) return reader.result;
        } else {
            read_row(reader, text);
        }
    }
    if (reader.result.grains.empty() && reader.result.problems.empty())
        reader.refuse("holds no grain", "At least one line after the header is needed.",
                      "Add grains.");
    return reader.result;
}

std::string population_csv(const Packing& grains) {
    std::string text = "id,x,y,radius\n";
    for (const PlacedGrain& grain : grains)
        text += fmt::format("{},{},{},{}\n", grain.id, grain.x, grain.y, grain.radius);
    return text;
}

void write_population_csv(const Packing& grains, const std::filesystem::path& file) {
    std::ofstream output(file);
    output << population_csv(grains);
    if (!output.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::vector<CaseProblem> check_population(const Packing& grains, const PopulationSource& source,
                                          const PackingBox& box, const SolidSides& walls) {
    std::vector<CaseProblem> problems;
    check_ids(grains, {problems, source});
    check_radii(grains, {problems, source});
    check_inside(grains, box, walls, {problems, source});
    check_overlaps(grains, box, {problems, source});
    return problems;
}

}  // namespace turbidite
