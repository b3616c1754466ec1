// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Records as bytes. Little-endian, eight bytes per number, doubles bit for bit, strings and lists
/// prefixed by their length. One `encode` and one `decode` per record; nothing else depends on
/// offsets. Valid C++17.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// A payload or a frame.
using Bytes = std::vector<char>;

/// Bytes that belong to somebody else: the payload inside a frame.
struct View {
    View(const char* first, std::size_t length) : data(first), size(length) {}
    View(const Bytes& bytes) : View(bytes.data(), bytes.size()) {}

    const char* data;
    std::size_t size;
};

/// A payload that is shorter or longer than, or different from, what its message kind requires.
class MalformedPayload : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// How numbers travel: a double, or a signed integer, of eight bytes.
template <class Number>
using Wide = std::conditional_t<std::is_floating_point_v<Number>, double, std::int64_t>;

/// The number that was sent as `wide`. Throws MalformedPayload if Number cannot be it: of a program
/// that writes shorter integers into places of eight bytes.
template <class Number>
Number narrowed(Wide<Number> wide) {
    const auto value = static_cast<Number>(wide);
    if constexpr (std::is_integral_v<Number>)
        if (static_cast<std::int64_t>(value) != wide)
            throw MalformedPayload(
                "holds " + std::to_string(wide) + ", which " +
                (std::is_same_v<Number, bool> ? "is neither 0 nor 1" : "is out of range there"));
    return value;
}

/// Appends numbers and texts to a payload.
class Writer {
 public:
    explicit Writer(Bytes& out) : out_(out) {}

    template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
    void operator()(const Number& value) {
        const auto wide = static_cast<Wide<Number>>(value);
        const std::size_t at = out_.size();
        out_.resize(at + sizeof wide);
        std::memcpy(out_.data() + at, &wide, sizeof wide);
    }
    void operator()(const std::string& text);

    /// Bytes as they are.
    void append(const char* from, std::size_t size) { out_.insert(out_.end(), from, from + size); }
    /// Room for so many more bytes.
    void expect(std::size_t more) { out_.reserve(out_.size() + more); }

 private:
    Bytes& out_;
};

/// Takes numbers and texts from a payload, in the order in which they were written. Throws
/// MalformedPayload where it ends too early.
class Reader {
 public:
    explicit Reader(View in) : in_(in) {}

    template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
    void operator()(Number& value) {
        Wide<Number> wide;
        std::memcpy(&wide, take(sizeof wide), sizeof wide);
        value = narrowed<Number>(wide);
    }
    void operator()(std::string& text);

    /// Length of a list, refused if the payload cannot hold that many entries.
    std::size_t length();

    /// The next `size` bytes. Throws MalformedPayload if there are fewer.
    const char* take(std::size_t size);

    /// Whether there is nothing left to read.
    bool at_end() const { return at_ == in_.size; }

    /// Throws MalformedPayload unless the whole payload was read.
    void finish() const;

 private:
    View in_;
    std::size_t at_ = 0;
};

/// Some grains of a motion, by their places in it: encoded as a Motion without contacts.
struct MotionShare {
    const Motion* of = nullptr;
    std::vector<std::uint32_t> places;

    std::vector<GrainState> grains() const;
};

/// The payload of a record.
/// @{
Bytes encode(const Hello&);
Bytes encode(const Settings&);
Bytes encode(const ShapeTable&);
Bytes encode(const Window&);
Bytes encode(const Motion&);
Bytes encode(const MotionShare&);
Bytes encode(const Kicks&);
Bytes encode(const std::vector<FreeResponse>&);
Bytes encode(const Box&);
Bytes encode(const std::string&);
/// @}

/// The record in a payload. Throws MalformedPayload.
template <class Record>
Record decode(View);

/// encode() behind what is already there, for the records that are long.
/// @{
void append(Bytes& out, const Motion&);
void append(Bytes& out, const MotionShare&);
void append(Bytes& out, const Kicks&);
void append(Bytes& out, const std::vector<FreeResponse>&);
template <class Record>
void append(Bytes& out, const Record& record) {
    const Bytes bytes = encode(record);
    out.insert(out.end(), bytes.begin(), bytes.end());
}
/// @}

}  // namespace turbidite
