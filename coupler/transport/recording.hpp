// SPDX-License-Identifier: LGPL-2.1-or-later
//
// All frames between the coupler and one participant in a file, in the order in which the coupler
// sent and received them: what `turbidite replay` plays to the participant again. The file is
//
//     magic, version, ranks                           of the participant
//     { sent by the coupler, rank, length, bytes }    one entry per frame
//
// where everything but the bytes is a signed 64-bit number, little-endian. An entry that is cut off
// ends the recording: that of a run that was killed.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

#include "coupler/transport/channel.hpp"

namespace turbidite {

struct RecordedFrame {
    bool sent_by_coupler = false;
    int peer = 0;
    Bytes bytes;
};

/// Writes such a file. One that cannot be written does not end the run: it is told once, and ends
/// there.
class RecordingWriter {
 public:
    using Tell = std::function<void(const std::string&)>;

    /// Throws Failure (participant failed) naming the file when it cannot be begun.
    RecordingWriter(std::filesystem::path file, int peers, Tell tell);
    ~RecordingWriter();
    void write(bool sent_by_coupler, int peer, const Bytes& bytes);

 private:
    void give_up();

    std::filesystem::path file_;
    std::ofstream out_;
    Tell tell_;
};

/// A channel that records what passes through another one.
class RecordingChannel final : public Channel {
 public:
    /// Throws and tells as RecordingWriter.
    RecordingChannel(Channel& channel, std::filesystem::path file, RecordingWriter::Tell tell);

    int peers() const override { return channel_.peers(); }
    void send(int peer, Bytes bytes) override;
    std::optional<Frame> try_receive() override;
    bool flushed() override { return channel_.flushed(); }
    bool in_transit() const override { return channel_.in_transit(); }

 private:
    Channel& channel_;
    RecordingWriter writer_;
};

class Recording {
 public:
    /// Throws Failure (bad input) naming the file if it is not a recording.
    explicit Recording(const std::filesystem::path& file);

    /// Ranks of the participant.
    int peers() const { return peers_; }

    /// Nothing at the end.
    std::optional<RecordedFrame> next();

 private:
    std::ifstream in_;
    int peers_ = 0;
    std::int64_t left_ = 0;  ///< bytes of the file that have not been read: no frame is longer
};

}  // namespace turbidite
