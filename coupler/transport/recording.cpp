// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/transport/recording.hpp"

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

constexpr std::int64_t magic = 0x6469627275745f31, version = 1;

void write_number(std::ofstream& out, std::int64_t number) {
    out.write(reinterpret_cast<const char*>(&number), sizeof number);
}

std::optional<std::int64_t> read_number(std::ifstream& in) {
    std::int64_t number = 0;
    in.read(reinterpret_cast<char*>(&number), sizeof number);
    return in ? std::optional(number) : std::nullopt;
}

}  // namespace

RecordingWriter::RecordingWriter(std::filesystem::path file, int peers, Tell tell)
    : file_(std::move(file)), tell_(std::move(tell)) {
    std::filesystem::create_directories(file_.parent_path());
    out_.open(file_, std::ios::binary);
    for (const std::int64_t number : {magic, version, std::int64_t{peers}})
        write_number(out_, number);
    if (!out_.flush())
        throw Failure(ExitCode::participant_failed, "cannot write " + file_.string());
}

RecordingWriter::~RecordingWriter() {
    if (out_.is_open() && !out_.flush()) give_up();
}

void RecordingWriter::write(bool sent_by_coupler, int peer, const Bytes& bytes) {
    if (!out_.is_open()) return;
    for (const std::int64_t number : {std::int64_t{sent_by_coupler}, std::int64_t{peer},
                                      static_cast<std::int64_t>(bytes.size())})
        write_number(out_, number);
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out_) give_up();
}

/// What follows would not fit what is there: nothing more is written.
void RecordingWriter::give_up() {
    out_.close();
    tell_("cannot write " + file_.string() +
          ": is the disk full? The recording ends here; the run goes on");
}

RecordingChannel::RecordingChannel(Channel& channel, std::filesystem::path file,
                                   RecordingWriter::Tell tell)
    : channel_(channel), writer_(std::move(file), channel.peers(), std::move(tell)) {}

void RecordingChannel::send(int peer, Bytes bytes) {
    // Before it is sent: an answer can never stand in front of its question.
    writer_.write(true, peer, bytes);
    channel_.send(peer, std::move(bytes));
}

std::optional<Channel::Frame> RecordingChannel::try_receive() {
    auto frame = channel_.try_receive();
    if (frame) writer_.write(false, frame->peer, frame->bytes);
    return frame;
}

Recording::Recording(const std::filesystem::path& file) : in_(file, std::ios::binary) {
    std::error_code none;
    // A missing file has no size and no numbers: refused below.
    left_ = static_cast<std::int64_t>(std::filesystem::file_size(file, none));
    const auto first = read_number(in_), second = read_number(in_), ranks = read_number(in_);
    if (first != magic)
        throw Failure(ExitCode::bad_input, file.string() + " is not a recording of turbidite");
    if (second != version || !ranks || *ranks < 1)
        throw Failure(ExitCode::bad_input, file.string() + " was recorded by another version");
    peers_ = static_cast<int>(*ranks);
    left_ -= 3 * static_cast<std::int64_t>(sizeof(std::int64_t));
}

std::optional<RecordedFrame> Recording::next() {
    const auto sent = read_number(in_), peer = read_number(in_), size = read_number(in_);
    left_ -= 3 * static_cast<std::int64_t>(sizeof(std::int64_t));
    // The file may be cut off or damaged: a length is believed only as far as there are bytes.
    if (!size || *size < 0 || *size > left_ || *peer < 0 || *peer >= peers_) return std::nullopt;
    left_ -= *size;
    RecordedFrame frame{*sent != 0, static_cast<int>(*peer),
                        Bytes(static_cast<std::size_t>(*size))};
    in_.read(frame.bytes.data(), static_cast<std::streamsize>(*size));
    return in_ ? std::optional(std::move(frame)) : std::nullopt;
}

}  // namespace turbidite
