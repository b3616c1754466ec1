// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How the layers of the fluid's cells are shared out among its ranks: cut by work, of which a cell
// covered by a grain has more than one of fluid alone.
#pragma once

#include <vector>

#include "coupler/protocol/settings.hpp"
#include "launcher/case/grains/packing/packing.hpp"

namespace turbidite {

/// Fewest layers of a rank: step 5 has a halo of three (planeField.cpp), and a rank should have
/// more layers than its halo.
inline constexpr int least_layers = 4;

/// Layers of cells of one y for every rank, from the bottom up, where the grains are as the run
/// begins. Empty with one rank, and where ranks have columns of cells.
std::vector<int> cut_by_work(const Settings& settings, const Packing& grains);

/// Where to cut layers of these weights into parts of nearly the same weight, each of at least
/// `least` layers, which there have to be enough of: the layers of each part.
std::vector<int> cut_evenly(const std::vector<double>& weights, int parts, int least);

}  // namespace turbidite
