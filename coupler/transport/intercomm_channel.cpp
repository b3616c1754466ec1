// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Calls are PMPI_*: inside a program with world isolation the MPI_* names belong to the host code.
#include "coupler/transport/intercomm_channel.hpp"

#include <limits>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

constexpr int frame_tag = 7;

}  // namespace

IntercommChannel::IntercommChannel(MPI_Comm intercomm) : intercomm_(intercomm) {
    PMPI_Comm_remote_size(intercomm_, &peers_);
}

void IntercommChannel::send(int peer, Bytes bytes) {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::length_error("a frame of " + std::to_string(bytes.size()) +
                                " bytes is more than MPI sends at once; use more ranks");
    flushed();  // forget what has left
    Pending& frame = pending_.emplace_back();
    frame.bytes = std::move(bytes);
    PMPI_Isend(frame.bytes.data(), static_cast<int>(frame.bytes.size()), MPI_BYTE, peer, frame_tag,
               intercomm_, &frame.request);
}

std::optional<Channel::Frame> IntercommChannel::try_receive() {
    int arrived = 0;
    MPI_Status status;
    PMPI_Iprobe(MPI_ANY_SOURCE, frame_tag, intercomm_, &arrived, &status);
    if (!arrived) {
        flushed();  // keeps long frames moving
        return std::nullopt;
    }
    int size = 0;
    PMPI_Get_count(&status, MPI_BYTE, &size);
    Frame frame{status.MPI_SOURCE, Bytes(static_cast<std::size_t>(size))};
    PMPI_Recv(frame.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, frame_tag, intercomm_,
              MPI_STATUS_IGNORE);
    return frame;
}

bool IntercommChannel::flushed() {
    for (auto frame = pending_.begin(); frame != pending_.end();) {
        int done = 0;
        PMPI_Test(&frame->request, &done, MPI_STATUS_IGNORE);
        frame = done ? pending_.erase(frame) : std::next(frame);
    }
    return pending_.empty();
}

}  // namespace turbidite
