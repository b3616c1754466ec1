// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Decompositions of a grid: for each cell i + nx j the rank that owns it.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace turbidite {

struct Decomposition {
    std::string name;
    std::function<int(int i, int j, int nx, int ny, int ranks)> rank_of;
};

inline const std::vector<Decomposition>& all_decompositions() {
    static const std::vector<Decomposition> list = {
        {"slabs in y", [](int, int j, int, int ny, int n) { return j * n / ny; }},
        {"slabs in y, topmost first",
         [](int, int j, int, int ny, int n) { return n - 1 - j * n / ny; }},
        {"uneven slabs", [](int, int j, int, int, int n) { return std::min(j, n - 1); }},
        {"slabs in x", [](int i, int, int nx, int, int n) { return i * n / nx; }},
        {"blocks",
         [](int i, int j, int nx, int ny, int n) { return (i * 2 / nx + 2 * (j * 2 / ny)) % n; }},
        {"checkerboard", [](int i, int j, int, int, int n) { return (i + j) % n; }},
        {"random",
         [](int i, int j, int nx, int, int n) {
             std::mt19937 random(17 + i + nx * j);
             return static_cast<int>(random() % n);
         }},
        {"all on the last rank", [](int, int, int, int, int n) { return n - 1; }},
    };
    return list;
}

/// Numbers of the cells of `rank`; in another order than that of the numbers if `shuffled`.
inline std::vector<int> cells_of(const Decomposition& decomposition, int nx, int ny, int rank,
                                 int ranks, bool shuffled = false) {
    std::vector<int> cells;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            if (decomposition.rank_of(i, j, nx, ny, ranks) == rank) cells.push_back(i + nx * j);
    std::mt19937 random(5);
    if (shuffled) std::shuffle(cells.begin(), cells.end(), random);
    return cells;
}

}  // namespace turbidite
