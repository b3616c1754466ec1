// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Serialisation to bytes and back, bit for bit, for checkpoints read on the same kind of machine.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace turbidite::nscd {

class ByteWriter {
 public:
    template <class T>
    void value(const T& x) {
        static_assert(std::is_trivially_copyable_v<T>);
        const char* first = reinterpret_cast<const char*>(&x);
        bytes_.insert(bytes_.end(), first, first + sizeof(T));
    }

    template <class T>
    void array(const std::vector<T>& x) {
        value(static_cast<std::uint64_t>(x.size()));
        for (const T& entry : x) value(entry);
    }

    std::vector<char> take() { return std::move(bytes_); }

 private:
    std::vector<char> bytes_;
};

class ByteReader {
 public:
    explicit ByteReader(const std::vector<char>& bytes) : bytes_(bytes) {}

    template <class T>
    T value() {
        static_assert(std::is_trivially_copyable_v<T>);
        demand(1, sizeof(T));
        T x;
        std::memcpy(&x, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return x;
    }

    template <class T>
    std::vector<T> array() {
        const auto count = value<std::uint64_t>();
        demand(count, sizeof(T));
        std::vector<T> x;
        x.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i) x.push_back(value<T>());
        return x;
    }

    bool at_end() const { return at_ == bytes_.size(); }

 private:
    void demand(std::uint64_t count, std::size_t size) const {
        if (count > (bytes_.size() - at_) / size)
            throw std::invalid_argument("saved contact state: the data is incomplete");
    }

    const std::vector<char>& bytes_;
    std::size_t at_ = 0;
};

}  // namespace turbidite::nscd
