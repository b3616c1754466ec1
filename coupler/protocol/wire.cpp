// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/wire.hpp"

namespace turbidite {

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
    if (size < 0 || static_cast<std::size_t>(size) > in_.size() - at_)
        throw MalformedPayload("a list announces " + std::to_string(size) + " entries in " +
                               std::to_string(in_.size() - at_) + " bytes");
    return static_cast<std::size_t>(size);
}

const char* Reader::take(std::size_t size) {
    if (size > in_.size() - at_)
        throw MalformedPayload("payload ends after " + std::to_string(in_.size()) + " bytes, " +
                               std::to_string(at_ + size) + " needed");
    const char* from = in_.data() + at_;
    at_ += size;
    return from;
}

void Reader::finish() const {
    if (at_ != in_.size())
        throw MalformedPayload("payload has " + std::to_string(in_.size() - at_) +
                               " bytes too many");
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

constexpr auto plain = [](auto& code, auto& value) { code(value); };

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
};

constexpr auto visit_contact = [](auto& code, auto& c) {
    code(c.a), code(c.b), code(c.wall), code(c.feature), code(c.status), code(c.gap),
        code(c.length);
    array(code, c.point), array(code, c.normal), array(code, c.branch);
    array(code, c.impulse), array(code, c.rolling_impulse);
};

constexpr auto visit_contacts = [](auto& code, auto& contacts) {
    list(code, contacts, visit_contact);
};

constexpr auto visit_motion = [](auto& code, auto& motion) {
    list(code, motion.grains, visit_grain);
    visit_contact_report(code, motion.report);
    maybe(code, motion.contacts, visit_contacts);
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
    list(code, kicks.kicks, visit_kick);
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
    list(code, responses, visit_response);
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
Bytes encoded(const Record& record, Visit visit) {
    Bytes out;
    Writer code(out);
    visit(code, record);
    return out;
}

template <class Record, class Visit>
Record decoded(const Bytes& in, Visit visit) {
    Record record;
    Reader code(in);
    visit(code, record);
    code.finish();
    return record;
}

}  // namespace

Bytes encode(const Motion& m) {
    return encoded(m, visit_motion);
}
Bytes encode(const Kicks& k) {
    return encoded(k, visit_kicks);
}
Bytes encode(const std::vector<FreeResponse>& r) {
    return encoded(r, visit_responses);
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
Motion decode(const Bytes& in) {
    return decoded<Motion>(in, visit_motion);
}
template <>
Kicks decode(const Bytes& in) {
    return decoded<Kicks>(in, visit_kicks);
}
template <>
std::vector<FreeResponse> decode(const Bytes& in) {
    return decoded<std::vector<FreeResponse>>(in, visit_responses);
}
template <>
ShapeTable decode(const Bytes& in) {
    return decoded<ShapeTable>(in, visit_shapes);
}
template <>
Window decode(const Bytes& in) {
    return decoded<Window>(in, visit_window);
}
template <>
Box decode(const Bytes& in) {
    return decoded<Box>(in, visit_box);
}
template <>
std::string decode(const Bytes& in) {
    return decoded<std::string>(in, plain);
}

template <>
Hello decode(const Bytes& in) {
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
Settings decode(const Bytes& in) {
    std::vector<Settings::Entry> entries;
    Reader code(in);
    list(code, entries, [](Reader& c, Settings::Entry& entry) { c(entry.first), c(entry.second); });
    code.finish();
    Settings settings;
    for (const auto& [key, value] : entries) settings.set(key, value);
    return settings;
}

}  // namespace turbidite
