// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Records as bytes. Little-endian, eight bytes per number, doubles bit for bit, strings and lists
// prefixed by their length. One `encode` and one `decode` per record; nothing else depends on
// offsets. Valid C++17.
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

using Bytes = std::vector<char>;

/// A payload that is shorter or longer than, or different from, what its message kind requires.
class MalformedPayload : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

class Writer {
 public:
    explicit Writer(Bytes& out) : out_(out) {}

    template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
    void operator()(const Number& value) {
        using Wide = std::conditional_t<std::is_floating_point_v<Number>, double, std::int64_t>;
        const Wide wide = static_cast<Wide>(value);
        const std::size_t at = out_.size();
        out_.resize(at + sizeof wide);
        std::memcpy(out_.data() + at, &wide, sizeof wide);
    }
    void operator()(const std::string& text);

 private:
    Bytes& out_;
};

class Reader {
 public:
    explicit Reader(const Bytes& in) : in_(in) {}

    template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
    void operator()(Number& value) {
        using Wide = std::conditional_t<std::is_floating_point_v<Number>, double, std::int64_t>;
        Wide wide;
        std::memcpy(&wide, take(sizeof wide), sizeof wide);
        value = static_cast<Number>(wide);
    }
    void operator()(std::string& text);

    /// Length of a list, refused if the payload cannot hold that many entries.
    std::size_t length();

    /// Throws MalformedPayload unless the whole payload was read.
    void finish() const;

 private:
    const char* take(std::size_t size);
    const Bytes& in_;
    std::size_t at_ = 0;
};

Bytes encode(const Hello&);
Bytes encode(const Settings&);
Bytes encode(const ShapeTable&);
Bytes encode(const Window&);
Bytes encode(const Motion&);
Bytes encode(const Kicks&);
Bytes encode(const std::vector<FreeResponse>&);
Bytes encode(const Box&);
Bytes encode(const std::string&);

/// Throws MalformedPayload.
template <class Record>
Record decode(const Bytes&);

}  // namespace turbidite
