// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Every kind of message there is: its fixed number, its name, who sends it to whom. One table,
/// linked by all programs. Numbers are part of the protocol: never reuse one. Valid C++17.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "coupler/protocol/files/stored_file.hpp"
#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/wire.hpp"

namespace turbidite {

/// The kinds of messages, with sender, receiver and payload.
enum class Kind : std::int32_t {
    // start
    hello = 1,       ///< participant → coupler   Hello
    settings = 2,    ///< coupler → participant   Settings
    order = 6,       ///< coupler → participant   Order: the messages of a window (call_order.hpp)
    shapes = 3,      ///< coupler → participant   ShapeTable
    population = 4,  ///< coupler → grains        Motion: this rank's share at t = 0
    domain = 5,      ///< fluid → coupler         Box of this rank
    // window
    window = 10,         ///< coupler → all       Window
    bodies = 18,         ///< coupler → fluid     Motion at t^n, routed by place
    response = 11,       ///< fluid → coupler     how grains respond to impulses
    contact_input = 12,  ///< coupler → grains    the same, routed by id
    motion = 13,         ///< grains → coupler    Motion after step 4
    constraint = 14,     ///< coupler → fluid     the same, routed by place
    accept = 19,         ///< coupler → fluid     the last constraint holds, no payload
    kicks = 15,          ///< fluid → coupler     Kicks after step 5
    kick = 16,           ///< coupler → grains    the same, routed by id
    state = 17,          ///< grains → coupler    Motion at t^{n+1} (and once at t = 0)
    // between two windows, when the coupler asks for it
    save = 20,      ///< coupler → participant    CheckpointPlace: write your state there
    saved = 21,     ///< participant → coupler    SavedPart
    restore = 22,   ///< coupler → participant    RestoreOrder: go on from there
    restored = 23,  ///< participant → coupler    no payload
    // end
    failure = 90,   ///< participant → coupler    exit code and text: I cannot go on
    dismiss = 91,   ///< coupler → participant    exit code and reason: the run is over
    farewell = 92,  ///< participant → coupler    everything written, ready to leave
    release = 93,   ///< coupler → participant    all are ready: leave now
};

/// "motion"; "kind 77" for a number that is not in the table.
std::string kind_name(Kind kind);

/// Position of a message in the run; compared with the expected one before its payload is used.
struct Envelope {
    Kind kind = Kind::hello;
    std::int64_t window = -1;    ///< -1 outside the window loop
    std::int64_t iteration = 0;  ///< rounds begun in this window
    std::int64_t sequence = 0;   ///< counts the messages of one sender to one receiver
};

/// A message apart from its frame.
struct Message {
    Envelope envelope;
    Bytes payload;  ///< a record, encoded
};

/// A message inside the frame in which it came.
class FramedMessage {
 public:
    /// Throws MalformedPayload when the frame is not one of this protocol.
    explicit FramedMessage(Bytes frame);

    Envelope envelope;

    View payload() const;  ///< valid as long as this object

 private:
    Bytes frame_;
};

/// A whole message as one frame of bytes.
Bytes frame(const Message& message);
/// And back. Throws MalformedPayload when the frame is not one of this protocol.
Message unframe(const Bytes& bytes);

/// A frame whose payload is still missing: append() it, then end_frame().
Bytes begin_frame(const Envelope& envelope);
/// The end of a frame whose payload is complete.
void end_frame(Bytes& frame);

/// frame({envelope, encode(record)}) without a copy of the payload.
template <class Record>
Bytes framed(const Envelope& envelope, const Record& record) {
    Bytes out = begin_frame(envelope);
    append(out, record);
    end_frame(out);
    return out;
}

/// Payload of `failure` and `dismiss`.
struct Verdict {
    std::int64_t exit_code = 0;  ///< an ExitCode
    std::string reason;          ///< for the user
};
/// See encode() and decode() of wire.hpp, here and below.
Bytes encode(const Verdict&);
template <>
Verdict decode(View);

/// Payload of `save`: where the parts of a checkpoint go, relative to the run folder.
struct CheckpointPlace {
    std::string folder;
};
Bytes encode(const CheckpointPlace&);
template <>
CheckpointPlace decode(View);

/// Payload of `saved`: the file a rank has written there, or why it could not.
struct SavedPart {
    StoredFile file;
    std::string fault;  ///< empty: the file is on the disk
};
Bytes encode(const SavedPart&);
template <>
SavedPart decode(View);

/// Payload of `restore`: the files of all ranks of this role, in the order of the ranks.
struct RestoreOrder {
    std::string folder;        ///< relative to the run folder
    std::int64_t windows = 0;  ///< done; the next window has this index
    std::vector<StoredFile> parts;
};
Bytes encode(const RestoreOrder&);
template <>
RestoreOrder decode(View);

}  // namespace turbidite
