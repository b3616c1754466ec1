// SPDX-License-Identifier: LGPL-2.1-or-later
#include <stdexcept>

#include "coupler/shapes/disc.hpp"
#include "coupler/shapes/shape.hpp"

namespace turbidite {

const std::vector<ShapeEntry>& shape_list() {
    static const std::vector<ShapeEntry> shapes = {
        {"disc", "round grain in the plane",
         [](const ShapeRecord&) -> std::shared_ptr<const Shape> { return std::make_shared<Disc>(); }},
    };
    return shapes;
}

std::shared_ptr<const Shape> make_shape(const ShapeRecord& record) {
    std::string known;
    for (const ShapeEntry& entry : shape_list()) {
        if (entry.kind == record.kind) return entry.make(record);
        known += (known.empty() ? "" : ", ") + entry.kind;
    }
    throw std::invalid_argument("unknown shape \"" + record.kind + "\"; known: " + known);
}

}  // namespace turbidite
