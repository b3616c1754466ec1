// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The stretches of a schedule in layers, for threads: those of a layer share no body, and any two
// that share one are in the order of the schedule, so that layer after layer is bitwise the same as
// stretch after stretch. Cells have eight parities (parity_grid.hpp), of which each is a layer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "granular_adapter/nscd/sweeps/sweep_layout.hpp"

namespace turbidite::nscd {

struct StretchLayers {
    /// By thread, its stretches: neighbours in the schedule, and about as much work for each.
    using Layer = std::vector<std::vector<std::size_t>>;
    std::vector<Layer> layers;

    template <class Rows>
    StretchLayers(const SweepLayout<Rows>& layout, int threads) {
        const std::vector<Stretch>& stretches = layout.schedule.stretches;
        std::vector<std::vector<std::size_t>> in_layer;
        std::vector<std::size_t> next(layout.bodies.size());  // layer that a body may be in
        for (std::size_t s = 0; s < stretches.size(); ++s) {
            std::size_t layer = 0;
            layout.each_slot(stretches[s],
                             [&](std::size_t slot) { layer = std::max(layer, next[slot]); });
            layout.each_slot(stretches[s], [&](std::size_t slot) { next[slot] = layer + 1; });
            if (layer == in_layer.size()) in_layer.emplace_back();
            in_layer[layer].push_back(s);
        }
        for (const std::vector<std::size_t>& members : in_layer)
            layers.push_back(shared_out(members, stretches, threads));
    }

 private:
    // Groups at rest are only looked at.
    static std::int64_t work(const Stretch& stretch) {
        const auto groups = [](const GroupRange& range) { return range.last - range.first; };
        return 8 * groups(stretch.active) + groups(stretch.resting) + 1;
    }

    static Layer shared_out(const std::vector<std::size_t>& members,
                            const std::vector<Stretch>& stretches, int threads) {
        std::int64_t all = 0, done = 0;
        for (const std::size_t s : members) all += work(stretches[s]);
        Layer layer(static_cast<std::size_t>(threads));
        for (const std::size_t s : members) {
            // The thread in whose share the middle of its work lies.
            const std::int64_t middle = done + work(stretches[s]) / 2;
            layer[static_cast<std::size_t>(middle * threads / all)].push_back(s);
            done += work(stretches[s]);
        }
        return layer;
    }
};

}  // namespace turbidite::nscd
