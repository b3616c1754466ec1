// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/soft/slips.hpp"

#include <utility>

namespace turbidite::soft {

void Slips::follow(const std::vector<Overlap>& points) {
    std::vector<nscd::ContactKey> names;
    std::vector<Vec3> slips;
    names.reserve(points.size()), slips.reserve(points.size());
    std::size_t old = 0;
    for (const Overlap& overlap : points) {
        while (old < names_.size() && names_[old] < overlap.name) ++old;
        const bool known = old < names_.size() && names_[old] == overlap.name;
        names.push_back(overlap.name);
        slips.push_back(known ? slips_[old] : Vec3{});
    }
    names_ = std::move(names), slips_ = std::move(slips);
}

void Slips::save(nscd::ByteWriter& writer) const {
    writer.array(names_);
    writer.array(slips_);
}

void Slips::restore(nscd::ByteReader& reader) {
    names_ = reader.array<nscd::ContactKey>();
    slips_ = reader.array<Vec3>();
}

}  // namespace turbidite::soft
