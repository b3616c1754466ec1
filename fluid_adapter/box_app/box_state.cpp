// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/box_state.hpp"

#include <algorithm>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

struct Header {
    std::int64_t layer = 0;  ///< cells of one
    std::int64_t first = 0, layers = 0;
    std::int64_t kind = 0;  ///< FluidStep::kind
};

/// Layers of cells, or of faces between them.
struct Layers {
    std::size_t first = 0, count = 0;

    std::size_t end() const { return first + count; }
};

Failure other_state() {
    return Failure(ExitCode::bad_input,
                   "the saved state of the fluid is of another mesh, fluid.time_scheme or "
                   "fluid.splitting, or incomplete; continue with the same ones");
}

/// Cells of one layer.
std::size_t layer_of(const BoxField& field) {
    return static_cast<std::size_t>(field.grid().counts[0]) * field.grid().counts[2];
}

/// One array after the other, in the order of the file.
using Arrays = std::vector<MemoryRows::Array>;

Arrays arrays_of(const BoxField& field, const BoxFluidStep& step) {
    Arrays arrays(field.grid().dimension + 1, {layer_of(field), 0});
    const Arrays memory = step.memory_rows().arrays;
    arrays.insert(arrays.end(), memory.begin(), memory.end());
    return arrays;
}

Layers layers_of(const MemoryRows::Array& array, const Layers& cells) {
    return {cells.first, cells.count + array.above};
}

/// Values of an array over these layers of cells.
std::size_t values_of(const MemoryRows::Array& array, const Layers& cells) {
    return array.width == 0 ? 1 : array.width * layers_of(array, cells).count;
}

/// The file of a rank, with the place of the array that is read next.
class RankFile {
 public:
    RankFile(PieceReader& file, const Arrays& arrays) : file_(file) {
        if (file.size() < sizeof header_) throw other_state();
        file.read(0, &header_, sizeof header_);
        cells_ = {static_cast<std::size_t>(header_.first),
                  static_cast<std::size_t>(header_.layers)};
        std::size_t bytes = sizeof header_;
        for (const MemoryRows::Array& array : arrays)
            bytes += values_of(array, cells_) * sizeof(double);
        if (file.size() != bytes) throw other_state();
    }

    const Header& header() const { return header_; }

    /// What the rank has of an array over these layers of cells.
    void read(const MemoryRows::Array& array, const Layers& own, double* values) {
        // Faces between two ranks are in the files of both, with the same values.
        const Layers to = layers_of(array, own), from = layers_of(array, cells_);
        const std::size_t first = std::max(to.first, from.first),
                          end = std::min(to.end(), from.end());
        if (array.width == 0)
            // A single value is the same in all files.
            file_.read(place_, values, sizeof(double));
        else if (first < end)
            file_.read(place_ + (first - from.first) * array.width * sizeof(double),
                       values + (first - to.first) * array.width,
                       (end - first) * array.width * sizeof(double));
        place_ += values_of(array, cells_) * sizeof(double);
    }

 private:
    PieceReader& file_;
    Header header_;
    Layers cells_;
    std::size_t place_ = sizeof(Header);
};

Header header_of(const BoxField& field, const BoxFluidStep& step) {
    const LayerCells layers = field.layers();
    return {static_cast<std::int64_t>(layer_of(field)), layers.first, layers.count, step.kind()};
}

/// Together they have all layers of this rank, from the same steps.
void demand_fit(const std::vector<RankFile>& files, const Header& own) {
    // Counted, not compared: the ranks that wrote a state had different layers.
    std::int64_t found = 0;
    for (const RankFile& file : files) {
        const Header& other = file.header();
        if (other.layer != own.layer || other.kind != own.kind) throw other_state();
        const std::int64_t end = std::min(own.first + own.layers, other.first + other.layers);
        found += std::max<std::int64_t>(0, end - std::max(own.first, other.first));
    }
    if (found != own.layers) throw other_state();
}

}  // namespace

void write_state(BoxField& field, BoxFluidStep& step, PieceWriter& file) {
    const auto write = [&](const double* values, std::size_t count) {
        file.write(values, count * sizeof(double));
    };
    const Header header = header_of(field, step);
    file.write(&header, sizeof header);
    const auto cells = static_cast<std::size_t>(field.owned_cells());
    for (const double* u : field.velocities()) write(u, cells);
    write(field.pressure().data(), cells);
    step.visit_memory(write);
}

void read_state(std::vector<PieceReader>& of_ranks, BoxField& field, BoxFluidStep& step) {
    const Arrays arrays = arrays_of(field, step);
    std::vector<RankFile> files;
    for (PieceReader& file : of_ranks) files.emplace_back(file, arrays);
    demand_fit(files, header_of(field, step));
    const LayerCells layers = field.layers();
    const Layers own{static_cast<std::size_t>(layers.first),
                     static_cast<std::size_t>(layers.count)};
    auto array = arrays.begin();
    const auto read = [&](double* values, std::size_t) {
        for (RankFile& file : files) file.read(*array, own, values);
        ++array;
    };
    for (double* u : field.velocities()) read(u, 0);
    read(field.pressure().data(), 0);
    // Before what the step remembers, which contains its own p where it keeps one.
    step.take_pressure();
    step.visit_memory(read);
}

}  // namespace turbidite
