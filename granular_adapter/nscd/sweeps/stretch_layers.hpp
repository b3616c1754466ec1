// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The stretches of a schedule in layers, for threads: those of a layer share no body, and any two
// that share one are in the order of the schedule, so that layer after layer is bitwise the same as
// stretch after stretch. Cells have eight parities (parity_grid.hpp), of which each is a layer.
#pragma once

#include <algorithm>
#include <atomic>
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

/// The layers while threads work on them. Each thread takes its own stretches and then, since it
/// cannot be known how long these take, what the others have left of theirs.
class SharedLayers {
 public:
    explicit SharedLayers(const StretchLayers& layers)
        : layers_(layers.layers), taken_(layers_.size()) {
        for (std::size_t layer = 0; layer < taken_.size(); ++layer)
            taken_[layer] = std::vector<Taken>(layers_[layer].size());
    }

    /// Calls visit(stretch), by all threads together once for each of the layer.
    template <class Visit>
    void each(std::size_t layer, int thread, const Visit& visit) {
        const StretchLayers::Layer& shares = layers_[layer];
        for (std::size_t n = 0; n < shares.size(); ++n) {
            const std::size_t share = (static_cast<std::size_t>(thread) + n) % shares.size();
            std::atomic<std::size_t>& taken = taken_[layer][share].stretches;
            for (std::size_t at = 0;
                 (at = taken.fetch_add(1, std::memory_order_relaxed)) < shares[share].size();)
                visit(shares[share][at]);
        }
    }

    /// For the next time, while no thread is in the layer.
    void refill(std::size_t layer) {
        for (Taken& share : taken_[layer]) share.stretches.store(0, std::memory_order_relaxed);
    }

 private:
    /// Stretches that have been taken from a share, in a cache line of its own.
    struct alignas(64) Taken {
        std::atomic<std::size_t> stretches{0};
        Taken() = default;
        Taken(const Taken&) {}
    };

    const std::vector<StretchLayers::Layer>& layers_;
    std::vector<std::vector<Taken>> taken_;
};

}  // namespace turbidite::nscd
