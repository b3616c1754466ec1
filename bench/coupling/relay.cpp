// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/coupling/relay.hpp"

#include <mpi.h>

#include <cstdint>

#include "bench/timing/step_clock.hpp"
#include "coupler/transport/channel.hpp"

namespace turbidite::bench {
namespace {

enum Rank { relay = 0, sink = 1, source = 2 };

constexpr int data_tag = 1, ready_tag = 2, time_tag = 3;

/// A blocking receive that leaves the core to the two others until its message begins.
void receive(std::vector<char>& buffer, int from) {
    MPI_Message message = MPI_MESSAGE_NULL;
    int arrived = 0;
    for (Patience patience; !arrived; patience.wait())
        MPI_Improbe(from, data_tag, MPI_COMM_WORLD, &arrived, &message, MPI_STATUS_IGNORE);
    MPI_Mrecv(buffer.data(), static_cast<int>(buffer.size()), MPI_BYTE, &message,
              MPI_STATUS_IGNORE);
}

void send(const std::vector<char>& buffer, int to) {
    MPI_Send(buffer.data(), static_cast<int>(buffer.size()), MPI_BYTE, to, data_tag,
             MPI_COMM_WORLD);
}

/// The next turn begins when the sink has the last one.
double send_timed(const std::vector<char>& buffer) {
    MPI_Recv(nullptr, 0, MPI_BYTE, sink, ready_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    const double begin = wall_seconds();
    send(buffer, relay);
    MPI_Send(&begin, 1, MPI_DOUBLE, sink, time_tag, MPI_COMM_WORLD);
    return begin;
}

double receive_timed(std::vector<char>& buffer) {
    MPI_Send(nullptr, 0, MPI_BYTE, source, ready_tag, MPI_COMM_WORLD);
    receive(buffer, relay);
    const double end = wall_seconds();
    double begin = 0.0;
    MPI_Recv(&begin, 1, MPI_DOUBLE, source, time_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return end - begin;
}

}  // namespace

std::vector<double> relayed(std::int64_t bytes, int turns) {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    std::vector<char> buffer(static_cast<std::size_t>(bytes), 'x');
    std::vector<double> seconds;
    for (int turn = 0; turn < turns; ++turn) {
        if (rank == source) send_timed(buffer);
        if (rank == sink) seconds.push_back(receive_timed(buffer));
        if (rank != relay) continue;
        receive(buffer, source);
        send(buffer, sink);
    }
    return seconds;
}

}  // namespace turbidite::bench
