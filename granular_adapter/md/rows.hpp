// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Arrays with one entry per body as rows of bytes with one row per body, to be sent along when the
// body moves to another rank: measure() all arrays, then pack() them in the same order; after the
// rows have been exchanged, unpack() them in that order.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace turbidite {

class RowPacker {
 public:
    template <class T>
    void measure(const std::vector<T>&) {
        static_assert(std::is_trivially_copyable_v<T>);
        row_size_ += sizeof(T);
    }

    std::size_t row_size() const { return row_size_; }
    std::vector<char> empty_rows(std::size_t count) const {
        return std::vector<char>(count * row_size_);
    }

    template <class T>
    void pack(const std::vector<T>& array, std::vector<char>& rows) {
        const std::size_t column = next_column(sizeof(T));
        for (std::size_t i = 0; i < array.size(); ++i)
            std::memcpy(&rows[i * row_size_ + column], &array[i], sizeof(T));
    }

    template <class T>
    void unpack(const std::vector<char>& rows, std::vector<T>& array) {
        const std::size_t column = next_column(sizeof(T));
        array.resize(rows.size() / row_size_);
        for (std::size_t i = 0; i < array.size(); ++i)
            std::memcpy(&array[i], &rows[i * row_size_ + column], sizeof(T));
    }

 private:
    /// Begins anew after the last column.
    std::size_t next_column(std::size_t size) {
        const std::size_t column = column_;
        column_ = (column_ + size) % row_size_;
        return column;
    }

    std::size_t row_size_ = 0, column_ = 0;
};

}  // namespace turbidite
