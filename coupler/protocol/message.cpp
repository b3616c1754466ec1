// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/message.hpp"

#include <utility>

namespace turbidite {
namespace {

// "turbidit" read as a number: distinguishes our frames from others on the same communicator.
constexpr std::int64_t magic = 0x7469646962727574;

// magic, kind, window, iteration, sequence, length of the payload
constexpr std::size_t header_bytes = 6 * sizeof(std::int64_t);

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

Bytes begin_frame(const Envelope& envelope) {
    Bytes out;
    Writer code(out);
    code(magic);
    code(static_cast<std::int32_t>(envelope.kind));
    code(envelope.window);
    code(envelope.iteration);
    code(envelope.sequence);
    code(std::int64_t{0});  // length of the payload
    return out;
}

void end_frame(Bytes& frame) {
    // The length is the last number of the header. It was unknown when the header was written.
    const auto payload = static_cast<std::int64_t>(frame.size() - header_bytes);
    std::memcpy(frame.data() + header_bytes - sizeof payload, &payload, sizeof payload);
}

Bytes frame(const Message& message) {
    Bytes out = begin_frame(message.envelope);
    out.insert(out.end(), message.payload.begin(), message.payload.end());
    end_frame(out);
    return out;
}

FramedMessage::FramedMessage(Bytes frame) : frame_(std::move(frame)) {
    Reader code(frame_);
    std::int64_t tag = 0;
    std::int32_t kind = 0;
    code(tag);
    if (tag != magic) throw MalformedPayload("not a frame of this protocol");
    // An unknown kind is no fault of the frame: the call order refuses it, with its number.
    code(kind);
    envelope.kind = static_cast<Kind>(kind);
    code(envelope.window);
    code(envelope.iteration);
    code(envelope.sequence);
    // No more than there is (Reader::length), and below no less: the frame ends with its payload.
    const std::size_t size = code.length();
    if (frame_.size() != size + header_bytes)
        throw MalformedPayload("frame of " + std::to_string(frame_.size()) + " bytes announces " +
                               std::to_string(size));
}

View FramedMessage::payload() const {
    return {frame_.data() + header_bytes, frame_.size() - header_bytes};
}

Message unframe(const Bytes& bytes) {
    const FramedMessage message(bytes);
    return {message.envelope, Bytes(bytes.begin() + header_bytes, bytes.end())};
}

Bytes encode(const Verdict& verdict) {
    Bytes out;
    Writer code(out);
    code(verdict.exit_code);
    code(verdict.reason);
    return out;
}

template <>
Verdict decode(View in) {
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
CheckpointPlace decode(View in) {
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
SavedPart decode(View in) {
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
RestoreOrder decode(View in) {
    RestoreOrder order;
    Reader code(in);
    code(order.folder), code(order.windows);
    order.parts.resize(code.length());
    for (StoredFile& part : order.parts) visit_file(code, part);
    code.finish();
    return order;
}

}  // namespace turbidite
