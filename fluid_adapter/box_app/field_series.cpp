// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/field_series.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "coupler/protocol/failure.hpp"
#include "fluid_adapter/fluid_window/slices.hpp"

namespace turbidite {
namespace {

/// An open file that several ranks write to.
class SharedFile {
 public:
    SharedFile(const std::filesystem::path& path, int flags)
        : number_(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0644)), good_(number_ >= 0) {}
    ~SharedFile() {
        if (number_ >= 0) ::close(number_);
    }
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    void write(std::size_t place, const void* from, std::size_t bytes) {
        for (std::size_t done = 0; good_ && done < bytes;) {
            const ssize_t more = ::pwrite(number_, static_cast<const char*>(from) + done,
                                          bytes - done, static_cast<off_t>(place + done));
            // pwrite may write a part, or be interrupted before it has written anything.
            if (more < 0 && errno == EINTR) continue;
            good_ = more > 0;
            if (good_) done += static_cast<std::size_t>(more);
        }
    }

    /// Closes it: some file systems tell only then that it could not be written.
    bool finish() {
        if (number_ >= 0) good_ = ::close(std::exchange(number_, -1)) == 0 && good_;
        return good_;
    }

 private:
    int number_;
    bool good_;
};

/// All but the values.
bool write_frame(const std::filesystem::path& file, const SliceLayout& layout) {
    // Places between are left open: the ranks write their values there.
    SharedFile out(file, O_CREAT | O_TRUNC);
    out.write(0, layout.begin.data(), layout.begin.size());
    for (std::size_t array = 0; array < layout.places.size(); ++array) {
        const std::uint64_t length = layout.lengths[array];
        out.write(layout.places[array], &length, sizeof length);
    }
    out.write(layout.place_of_end(), layout.end.data(), layout.end.size());
    return out.finish();
}

/// Rows of one z, x fastest, over this rank's layers: they lie together in the file.
bool write_own(const std::filesystem::path& file, const SliceLayout& layout,
               const StoredField& field, const std::vector<WrittenField>& fields) {
    const LayerCells layers = field.layers();
    const std::array<int, 3>& counts = field.grid().counts;
    SharedFile out(file, 0);
    std::vector<float> rows;
    for (std::size_t array = 0; array < fields.size(); ++array) {
        const int components = fields[array].components;
        CellIndex at{};
        for (at[2] = 0; at[2] < counts[2]; ++at[2]) {
            rows.clear();
            for (at[1] = layers.first; at[1] < layers.first + layers.count; ++at[1])
                for (at[0] = 0; at[0] < counts[0]; ++at[0])
                    for (int c = 0; c < components; ++c)
                        rows.push_back(static_cast<float>(
                            fields[array].value(layers.cell(at[0], at[1], at[2]), at, c)));
            // x fastest, then y, then z, while layers have z before y: of one z the rank's rows
            // follow each other.
            const std::size_t cell =
                counts[0] * (layers.first + static_cast<std::size_t>(counts[1]) * at[2]);
            out.write(layout.values(array) + cell * components * sizeof(float), rows.data(),
                      rows.size() * sizeof(float));
        }
    }
    return out.finish();
}

SliceLayout layout_of(const CellGrid& grid, const std::vector<WrittenField>& fields) {
    std::vector<SliceArray> arrays;
    for (const WrittenField& field : fields) arrays.push_back({field.name, field.components, {}});
    return slice_layout({edges_along(grid, 0), edges_along(grid, 1), edges_along(grid, 2)}, arrays);
}

void demand(bool good, const std::filesystem::path& file) {
    if (good) return;
    std::error_code ignored;  // the failure itself is told
    std::filesystem::remove(file, ignored);
    throw Failure(ExitCode::participant_failed,
                  "cannot write " + file.string() + ": is the disk full?");
}

}  // namespace

FieldSeries::FieldSeries(std::filesystem::path fluid_folder, double step)
    : folder_(std::move(fluid_folder) / "fields"), step_(step) {}

void FieldSeries::write(const StoredField& field, const RankGroup& ranks,
                        const std::vector<WrittenField>& fields, std::int64_t windows) const {
    const std::filesystem::path file = folder_ / slice_file_name("fields", windows);
    const std::filesystem::path part = file.string() + ".part";
    const SliceLayout layout = layout_of(field.grid(), fields);
    const bool first = ranks.rank() == 0;
    std::error_code failed;
    // Rank 0 makes the file, with everything but values; `all` keeps the others waiting until it is
    // there, and makes all of them throw if one cannot write.
    if (first) std::filesystem::create_directories(folder_, failed);
    demand(ranks.all(!first || (!failed && write_frame(part, layout))), part);
    demand(ranks.all(write_own(part, layout, field, fields)), part);
    // Under its name only when it is complete
    if (first) std::filesystem::rename(part, file, failed);
    demand(ranks.all(!failed), part);
    if (first) write_slice_series(folder_ / "fields.pvd", {"fields"}, step_);
}

}  // namespace turbidite
