// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/wire.hpp"

#include <algorithm>

namespace turbidite {

std::vector<GrainState> MotionShare::grains() const {
    std::vector<GrainState> copies;
    for (const std::uint32_t place : places) copies.push_back(of->grains[place]);
    return copies;
}

void Writer::operator()(const std::string& text) {
    (*this)(static_cast<std::int64_t>(text.size()));
    out_.insert(out_.end(), text.begin(), text.end());
}

void Reader::operator()(std::string& text) {
    const std::size_t size = length();
    const char* from = take(size);
    text.assign(from, size);
}

std::size_t Reader::length() {
    std::int64_t size = 0;
    (*this)(size);
    // An entry has at least one byte, so a length above the bytes that are left is false: refused
    // before memory is asked for.
    if (size < 0 || static_cast<std::size_t>(size) > in_.size - at_)
        throw MalformedPayload("a list announces " + std::to_string(size) + " entries in " +
                               std::to_string(in_.size - at_) + " bytes");
    return static_cast<std::size_t>(size);
}

const char* Reader::take(std::size_t size) {
    if (size > in_.size - at_)
        throw MalformedPayload("payload ends after " + std::to_string(in_.size) + " bytes, " +
                               std::to_string(at_ + size) + " needed");
    const char* from = in_.data + at_;
    at_ += size;
    return from;
}

void Reader::finish() const {
    if (at_ != in_.size)
        throw MalformedPayload("payload has " + std::to_string(in_.size - at_) + " bytes too many");
}

namespace {

// One description per record serves both directions: `visit(record, code)` passes every field to
// `code`, a Writer or a Reader.

template <class Code, class Array>
void array(Code& code, Array& values) {
    for (auto& value : values) code(value);
}

template <class Record, class Visit>
void list(Writer& code, const std::vector<Record>& records, Visit visit) {
    code(static_cast<std::int64_t>(records.size()));
    for (const Record& record : records) visit(code, record);
}

template <class Record, class Visit>
void list(Reader& code, std::vector<Record>& records, Visit visit) {
    records.resize(code.length());
    for (Record& record : records) visit(code, record);
}

template <class Value, class Visit>
void maybe(Writer& code, const std::optional<Value>& value, Visit visit) {
    code(value.has_value());
    if (value) visit(code, *value);
}

template <class Value, class Visit>
void maybe(Reader& code, std::optional<Value>& value, Visit visit) {
    bool given = false;
    code(given);
    value.reset();
    if (given) visit(code, value.emplace());
}

/// An optional value at the end of a payload, which older programs do not know: where it is missing
/// there is nothing, not even the flag of maybe(), so that they stay as they were.
template <class Value>
void trailing(Writer& code, const std::optional<Value>& value) {
    if (value) code(true), code(*value);
}

template <class Value>
void trailing(Reader& code, std::optional<Value>& value) {
    value.reset();
    if (code.at_end()) return;
    bool given = false;
    // Written only with the flag 1: a 0 here is not what any program of ours sends.
    code(given), code(value.emplace());
    if (!given) throw MalformedPayload("payload ends with a value that is said not to be there");
}

// Records of a fixed number of numbers, of which there may be millions: one check of the length,
// then each record in one go.

class NumberCount {
 public:
    template <class Number>
    void operator()(const Number&) {
        ++numbers;
    }
    std::size_t numbers = 0;
};

class BlockWriter {
 public:
    explicit BlockWriter(char* to) : to_(to) {}
    template <class Number>
    void operator()(const Number& value) {
        const auto wide = static_cast<Wide<Number>>(value);
        std::memcpy(to_, &wide, sizeof wide);
        to_ += sizeof wide;
    }

 private:
    char* to_;
};

class BlockReader {
 public:
    explicit BlockReader(const char* from) : from_(from) {}
    template <class Number>
    void operator()(Number& value) {
        Wide<Number> wide;
        std::memcpy(&wide, from_, sizeof wide);
        value = narrowed<Number>(wide);
        from_ += sizeof wide;
    }

 private:
    const char* from_;
};

template <class Record, class Visit>
std::size_t bytes_per(Visit visit) {
    NumberCount count;
    // By visiting one: every field of these records has eight bytes, whatever its type.
    const Record record;
    visit(count, record);
    return count.numbers * sizeof(double);
}

/// `record_at(i)` for i below `count`. Goes through a block that stays in the cache.
template <class Record, class Visit, class RecordAt>
void table(Writer& code, std::size_t count, Visit visit, RecordAt record_at) {
    // Some 8 kB of grains.
    constexpr std::size_t at_once = 32;
    const std::size_t each = bytes_per<Record>(visit);
    code(static_cast<std::int64_t>(count));
    code.expect(count * each);
    std::vector<char> block(at_once * each);
    for (std::size_t first = 0; first < count; first += at_once) {
        const std::size_t now = std::min(at_once, count - first);
        BlockWriter to(block.data());
        for (std::size_t i = first; i < first + now; ++i) visit(to, record_at(i));
        code.append(block.data(), now * each);
    }
}

template <class Record, class Visit>
void table(Writer& code, const std::vector<Record>& records, Visit visit) {
    table<Record>(code, records.size(), visit,
                  [&](std::size_t i) -> const Record& { return records[i]; });
}

template <class Record, class Visit>
void table(Reader& code, std::vector<Record>& records, Visit visit) {
    const std::size_t count = code.length(), each = bytes_per<Record>(visit);
    BlockReader from(code.take(count * each));  // no overflow: `count` bytes are there
    records.clear();
    records.reserve(count);
    for (std::size_t i = 0; i < count; ++i) visit(from, records.emplace_back());
}

constexpr auto plain = [](auto& code, auto& value) { code(value); };

// The order of the fields, here and below, is the protocol (docs/protocol.md, Records).
constexpr auto visit_grain = [](auto& code, auto& g) {
    code(g.id), code(g.shape), code(g.material), code(g.prescribed);
    code(g.radius), code(g.density);
    array(code, g.position), array(code, g.orientation);
    array(code, g.velocity), array(code, g.angular_velocity);
    array(code, g.contact_impulse), array(code, g.contact_angular_impulse);
    array(code, g.announced_impulse), array(code, g.announced_angular_impulse);
};

constexpr auto visit_contact_report = [](auto& code, auto& r) {
    code(r.contacts), code(r.iterations), maybe(code, r.residual, plain), code(r.converged);
    code(r.max_penetration), code(r.removed), code(r.wall_seconds);
    maybe(code, r.quad, plain), maybe(code, r.max, plain);
    maybe(code, r.contact_violation, plain);
};

constexpr auto visit_contact = [](auto& code, auto& c) {
    code(c.a), code(c.b), code(c.wall), code(c.feature), code(c.status), code(c.gap),
        code(c.length);
    array(code, c.point), array(code, c.normal), array(code, c.branch);
    array(code, c.impulse), array(code, c.rolling_impulse);
};

constexpr auto visit_contacts = [](auto& code, auto& contacts) {
    table(code, contacts, visit_contact);
};

constexpr auto visit_motion = [](auto& code, auto& motion) {
    table(code, motion.grains, visit_grain);
    visit_contact_report(code, motion.report);
    maybe(code, motion.contacts, visit_contacts);
    // Since 1.10, behind the contacts, where older programs end their motion.
    trailing(code, motion.report.film_work);
};

constexpr auto visit_kick = [](auto& code, auto& k) {
    code(k.id), array(code, k.velocity), array(code, k.angular_velocity);
    array(code, k.multiplier_impulse), array(code, k.multiplier_angular_impulse);
    array(code, k.force), array(code, k.torque);
};

constexpr auto visit_splitting = [](auto& code, auto& s) {
    code(s.pressure_iterations), code(s.viscous_iterations);
    code(s.divergence), code(s.viscous_residual), code(s.converged);
};

constexpr auto visit_kicks = [](auto& code, auto& kicks) {
    table(code, kicks.kicks, visit_kick);
    auto& r = kicks.report;
    code(r.multiplier_iterations), code(r.multiplier_residual), code(r.multipliers_converged);
    code(r.divergence), code(r.final_divergence), code(r.momentum_defect);
    code(r.courant), maybe(code, r.splitting, visit_splitting);
    array(code, r.mean_velocity), code(r.wall_seconds);
    list(code, r.probes, plain);
};

constexpr auto visit_response = [](auto& code, auto& r) {
    code(r.id), array(code, r.velocity), array(code, r.angular_velocity), array(code, r.inertia);
    code(r.mismatch);
};

constexpr auto visit_responses = [](auto& code, auto& responses) {
    table(code, responses, visit_response);
};

constexpr auto visit_shapes = [](auto& code, auto& shapes) {
    list(code, shapes, [](auto& c, auto& s) { c(s.kind), list(c, s.vertices, plain); });
};

constexpr auto visit_window = [](auto& code, auto& w) {
    code(w.index), code(w.time), code(w.step), code(w.write_output);
};

constexpr auto visit_box = [](auto& code, auto& b) { array(code, b.lower), array(code, b.upper); };

constexpr auto visit_capabilities = [](auto& code, auto& c) {
    code(c.saves_state), code(c.restores_within_window), code(c.serialises_state);
    code(c.native_substeps), code(c.effective_inertia);
    list(code, c.shapes, plain), list(code, c.contact_laws, plain);
};

constexpr auto visit_hello = [](auto& code, auto& h) {
    code(h.protocol_major), code(h.protocol_minor);
    code(h.adapter), code(h.adapter_version), code(h.host_code);
    code(h.dimension), code(h.rank), code(h.ranks), code(h.host), code(h.pid), code(h.log_file);
    code(h.case_hash);
    visit_capabilities(code, h.capabilities);
};

template <class Record, class Visit>
void append_visited(Bytes& out, const Record& record, Visit visit) {
    Writer code(out);
    visit(code, record);
}

template <class Record, class Visit>
Bytes encoded(const Record& record, Visit visit) {
    Bytes out;
    append_visited(out, record, visit);
    return out;
}

template <class Record>
Bytes appended(const Record& record) {
    Bytes out;
    append(out, record);
    return out;
}

template <class Record, class Visit>
Record decoded(View in, Visit visit) {
    Record record;
    Reader code(in);
    visit(code, record);
    code.finish();
    return record;
}

}  // namespace

void append(Bytes& out, const Motion& m) {
    append_visited(out, m, visit_motion);
}
void append(Bytes& out, const Kicks& k) {
    append_visited(out, k, visit_kicks);
}
void append(Bytes& out, const std::vector<FreeResponse>& r) {
    append_visited(out, r, visit_responses);
}
void append(Bytes& out, const MotionShare& share) {
    Writer code(out);
    table<GrainState>(
        code, share.places.size(), visit_grain,
        [&](std::size_t i) -> const GrainState& { return share.of->grains[share.places[i]]; });
    visit_contact_report(code, share.of->report);
    // The fluid needs neither contacts nor the work of films: a Motion that ends with the flag 0.
    maybe(code, std::optional<std::vector<ContactRecord>>{}, visit_contacts);
}

Bytes encode(const Motion& m) {
    return appended(m);
}
Bytes encode(const MotionShare& share) {
    return appended(share);
}
Bytes encode(const Kicks& k) {
    return appended(k);
}
Bytes encode(const std::vector<FreeResponse>& r) {
    return appended(r);
}
Bytes encode(const ShapeTable& s) {
    return encoded(s, visit_shapes);
}
Bytes encode(const Window& w) {
    return encoded(w, visit_window);
}
Bytes encode(const Box& b) {
    return encoded(b, visit_box);
}
Bytes encode(const std::string& text) {
    return encoded(text, plain);
}

Bytes encode(const Hello& hello) {
    Bytes out;
    Writer code(out);
    code(static_cast<std::int32_t>(hello.role));
    visit_hello(code, hello);
    return out;
}

Bytes encode(const Settings& settings) {
    Bytes out;
    Writer code(out);
    list(code, settings.entries(),
         [](Writer& c, const Settings::Entry& entry) { c(entry.first), c(entry.second); });
    return out;
}

template <>
Motion decode(View in) {
    return decoded<Motion>(in, visit_motion);
}
template <>
Kicks decode(View in) {
    return decoded<Kicks>(in, visit_kicks);
}
template <>
std::vector<FreeResponse> decode(View in) {
    return decoded<std::vector<FreeResponse>>(in, visit_responses);
}
template <>
ShapeTable decode(View in) {
    return decoded<ShapeTable>(in, visit_shapes);
}
template <>
Window decode(View in) {
    return decoded<Window>(in, visit_window);
}
template <>
Box decode(View in) {
    return decoded<Box>(in, visit_box);
}
template <>
std::string decode(View in) {
    return decoded<std::string>(in, plain);
}

template <>
Hello decode(View in) {
    Hello hello;
    Reader code(in);
    std::int32_t role = 0;
    code(role);
    hello.role = static_cast<Role>(role);
    visit_hello(code, hello);
    code.finish();
    return hello;
}

template <>
Settings decode(View in) {
    std::vector<Settings::Entry> entries;
    Reader code(in);
    list(code, entries, [](Reader& c, Settings::Entry& entry) { c(entry.first), c(entry.second); });
    code.finish();
    Settings settings;
    for (const auto& [key, value] : entries) settings.set(key, value);
    return settings;
}

}  // namespace turbidite
