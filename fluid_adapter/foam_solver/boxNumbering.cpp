// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/boxNumbering.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace turbidite {
namespace {

/// The neighbours of each cell, in ascending order.
using Neighbours = std::vector<std::vector<int>>;

std::string cell_name(int cell) {
    return "cell " + std::to_string(cell);
}

Neighbours neighbours_of(const CellFaces& faces) {
    Neighbours of(faces.count);
    for (std::size_t f = 0; f < faces.low.size(); ++f) {
        of[faces.low[f]].push_back(faces.high[f]);
        of[faces.high[f]].push_back(faces.low[f]);
    }
    for (std::size_t c = 0; c < of.size(); ++c) {
        if (of[c].size() < 2 || of[c].size() > 4)
            throw DoesNotFit(cell_name(c) + " has " + std::to_string(of[c].size()) +
                             " neighbours; in one layer of cells, 3 x 3 or more, it has 2 to 4");
        std::sort(of[c].begin(), of[c].end());
    }
    return of;
}

/// The first row: along the boundary from the first corner to the next.
std::vector<int> first_row(const Neighbours& of) {
    const auto corner =
        std::find_if(of.begin(), of.end(), [](const auto& list) { return list.size() == 2; });
    if (corner == of.end()) throw DoesNotFit("no cell is a corner, with 2 neighbours");
    // The corner with the smallest number, towards its neighbour with the smaller one
    std::vector<int> row = {static_cast<int>(corner - of.begin()), corner->front()};
    // Cells at a side have three neighbours: one before, one inside with four, one ahead.
    while (of[row.back()].size() == 3) {
        const int last = row.back(), before = row[row.size() - 2];
        const auto next = std::find_if(of[last].begin(), of[last].end(), [&](int cell) {
            return cell != before && of[cell].size() < 4;
        });
        // A boundary that never meets a corner would be followed for ever.
        if (next == of[last].end() || row.size() == of.size())
            throw DoesNotFit("the boundary through " + cell_name(last) +
                             " does not end at a corner");
        row.push_back(*next);
    }
    return row;
}

/// The next row: for each cell of a row, its only neighbour without a place. Empty after the last
/// row.
std::vector<int> row_across(const std::vector<int>& row, const Neighbours& of,
                            const std::vector<int>& place) {
    std::vector<int> across;
    for (int cell : row)
        for (int next : of[cell])
            if (place[next] < 0) across.push_back(next);
    if (across.empty() || across.size() == row.size()) return across;
    throw DoesNotFit("next to the row that starts at " + cell_name(row.front()) + " there are " +
                     std::to_string(across.size()) + " cells instead of " +
                     std::to_string(row.size()) + ": the mesh has a step or a hole there");
}

void check_neighbours(const CellFaces& faces, const BoxNumbering& box) {
    for (std::size_t f = 0; f < faces.low.size(); ++f) {
        const int a = faces.low[f], b = faces.high[f];
        const int columns = std::abs(box.column(a) - box.column(b));
        const int rows = std::abs(box.row(a) - box.row(b));
        if (columns + rows != 1)
            throw DoesNotFit(cell_name(a) + " and " + cell_name(b) +
                             " share a face but are not neighbours in a box");
    }
}

void check_complete(const CellFaces& faces, const BoxNumbering& box) {
    const int nx = box.cells[0], ny = box.cells[1];
    const int between = static_cast<int>(faces.low.size());
    // nx (ny - 1) + ny (nx - 1) faces: with fewer the box would have slits.
    if (nx * ny != faces.count || between != 2 * nx * ny - nx - ny)
        throw DoesNotFit("its " + std::to_string(faces.count) +
                         " cells are not one box of rows and columns");
    if (nx < 3 || ny < 3)
        throw DoesNotFit("it has " + std::to_string(nx) + " x " + std::to_string(ny) +
                         " cells; at least 3 x 3 are needed");
}

}  // namespace

BoxNumbering number_box(const CellFaces& faces) {
    const Neighbours of = neighbours_of(faces);
    BoxNumbering box;
    box.place.assign(of.size(), -1);
    int next_place = 0;
    for (std::vector<int> row = first_row(of); !row.empty(); row = row_across(row, of, box.place)) {
        if (box.cells[1]++ == 0) box.cells[0] = static_cast<int>(row.size());
        for (int cell : row) box.place[cell] = next_place++;
    }
    check_complete(faces, box);
    check_neighbours(faces, box);
    return box;
}

}  // namespace turbidite
