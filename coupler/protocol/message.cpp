// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/message.hpp"

#include <utility>

namespace turbidite {
namespace {

// "turbidit" read as a number: distinguishes our frames from others on the same communicator.
constexpr std::int64_t magic = 0x7469646962727574;

const std::vector<std::pair<Kind, const char*>> kinds = {
    {Kind::hello, "hello"},
    {Kind::settings, "settings"},
    {Kind::order, "order"},
    {Kind::shapes, "shapes"},
    {Kind::population, "population"},
    {Kind::domain, "domain"},
    {Kind::window, "window"},
    {Kind::bodies, "bodies"},
    {Kind::response, "response"},
    {Kind::contact_input, "contact_input"},
    {Kind::motion, "motion"},
    {Kind::constraint, "constraint"},
    {Kind::accept, "accept"},
    {Kind::kicks, "kicks"},
    {Kind::kick, "kick"},
    {Kind::state, "state"},
    {Kind::save, "save"},
    {Kind::saved, "saved"},
    {Kind::restore, "restore"},
    {Kind::restored, "restored"},
    {Kind::failure, "failure"},
    {Kind::dismiss, "dismiss"},
    {Kind::farewell, "farewell"},
    {Kind::release, "release"},
};

template <class Code, class File>
void visit_file(Code& code, File& file) {
    code(file.name), code(file.bytes), code(file.crc32);
}

}  // namespace

std::string kind_name(Kind kind) {
    for (const auto& [known, name] : kinds)
        if (known == kind) return name;
    return "kind " + std::to_string(static_cast<std::int32_t>(kind));
}

Bytes frame(const Message& message) {
    Bytes out;
    out.reserve(message.payload.size() + 6 * sizeof(std::int64_t));
    Writer code(out);
    code(magic);
    code(static_cast<std::int32_t>(message.envelope.kind));
    code(message.envelope.window);
    code(message.envelope.iteration);
    code(message.envelope.sequence);
    code(static_cast<std::int64_t>(message.payload.size()));
    out.insert(out.end(), message.payload.begin(), message.payload.end());
    return out;
}

Message unframe(const Bytes& bytes) {
    Reader code(bytes);
    std::int64_t tag = 0;
    std::int32_t kind = 0;
    Message message;
    code(tag);
    if (tag != magic) throw MalformedPayload("not a frame of this protocol");
    code(kind);
    message.envelope.kind = static_cast<Kind>(kind);
    code(message.envelope.window);
    code(message.envelope.iteration);
    code(message.envelope.sequence);
    const std::size_t size = code.length();
    message.payload.assign(bytes.end() - static_cast<std::ptrdiff_t>(size), bytes.end());
    if (bytes.size() != size + 6 * sizeof(std::int64_t))
        throw MalformedPayload("frame of " + std::to_string(bytes.size()) + " bytes announces " +
                               std::to_string(size));
    return message;
}

Bytes encode(const Verdict& verdict) {
    Bytes out;
    Writer code(out);
    code(verdict.exit_code);
    code(verdict.reason);
    return out;
}

template <>
Verdict decode(const Bytes& in) {
    Verdict verdict;
    Reader code(in);
    code(verdict.exit_code);
    code(verdict.reason);
    code.finish();
    return verdict;
}

Bytes encode(const CheckpointPlace& place) {
    Bytes out;
    Writer code(out);
    code(place.folder);
    return out;
}

template <>
CheckpointPlace decode(const Bytes& in) {
    CheckpointPlace place;
    Reader code(in);
    code(place.folder);
    code.finish();
    return place;
}

Bytes encode(const SavedPart& part) {
    Bytes out;
    Writer code(out);
    visit_file(code, part.file);
    code(part.fault);
    return out;
}

template <>
SavedPart decode(const Bytes& in) {
    SavedPart part;
    Reader code(in);
    visit_file(code, part.file);
    code(part.fault);
    code.finish();
    return part;
}

Bytes encode(const RestoreOrder& order) {
    Bytes out;
    Writer code(out);
    code(order.folder), code(order.windows);
    code(static_cast<std::int64_t>(order.parts.size()));
    for (const StoredFile& part : order.parts) visit_file(code, part);
    return out;
}

template <>
RestoreOrder decode(const Bytes& in) {
    RestoreOrder order;
    Reader code(in);
    code(order.folder), code(order.windows);
    order.parts.resize(code.length());
    for (StoredFile& part : order.parts) visit_file(code, part);
    code.finish();
    return order;
}

}  // namespace turbidite
