// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/transport/doorbell.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace turbidite {
namespace {

constexpr std::size_t longest_name = 100;
constexpr int most_heard = 1024;  // rings per sleep: more than a socket queues

int new_socket() {
    return ::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
}

struct Address {
    explicit Address(const std::string& name)
        : length(static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size())) {
        socket.sun_family = AF_UNIX;
        // Names of the abstract namespace begin with a zero.
        std::memcpy(socket.sun_path + 1, name.data(), name.size());
    }

    const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&socket); }

    sockaddr_un socket{};
    socklen_t length;
};

/// Whether there was a ring, and whether it counts: everybody on the host knows the name, but only
/// programs of the same user, or the system's, belong to the job.
struct Ring {
    bool any = false, counts = false;
};

Ring next_ring(int bell) {
    char rung = 0;
    iovec place{&rung, 1};
    // The kernel fills in who has sent it (SO_PASSCRED, install()): another user cannot forge it.
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(ucred))];
    msghdr message{};
    message.msg_iov = &place, message.msg_iovlen = 1;
    message.msg_control = control, message.msg_controllen = sizeof control;
    if (::recvmsg(bell, &message, MSG_DONTWAIT) < 0) return {};
    const cmsghdr* head = CMSG_FIRSTHDR(&message);
    if (head == nullptr || head->cmsg_type != SCM_CREDENTIALS) return {true, false};
    ucred sender{};
    std::memcpy(&sender, CMSG_DATA(head), sizeof sender);
    return {true, sender.uid == ::geteuid() || sender.uid == 0};
}

timespec time_of(double seconds) {
    const double whole = std::floor(seconds);
    return {static_cast<time_t>(whole), static_cast<long>((seconds - whole) * 1e9)};
}

}  // namespace

Doorbell& Doorbell::own() {
    static Doorbell bell;
    return bell;
}

Doorbell::~Doorbell() {
    if (socket_ >= 0) ::close(socket_);
}

bool Doorbell::install(const std::string& name) {
    if (socket_ >= 0) return true;
    if (name.size() > longest_name) return false;
    const int made = new_socket(), yes = 1;
    const Address address(name);
    // Before bind: no ring may come in without its sender's credentials.
    ::setsockopt(made, SOL_SOCKET, SO_PASSCRED, &yes, sizeof yes);
    if (::bind(made, address.get(), address.length) == 0) {
        socket_ = made;
        return true;
    }
    if (made >= 0) ::close(made);
    return false;
}

bool Doorbell::sleep(double seconds) {
    // Without a bell the descriptor is -1, which ppoll leaves out: a plain sleep.
    pollfd ring{socket_, POLLIN, 0};
    const timespec limit = time_of(seconds);
    // 0: nobody has rung. -1: a signal, which ends the sleep like the time limit.
    if (::ppoll(&ring, 1, &limit, nullptr) <= 0) return false;
    bool rung = false;  // several rings are one
    Ring ring_now{true, false};
    for (int heard = 0; heard < most_heard && ring_now.any; ++heard) {
        ring_now = next_ring(socket_);
        rung = rung || ring_now.counts;
    }
    return rung;
}

void BellButton::ring() {
    // One nameless socket for all buttons of the process; nobody answers a ring.
    static const int from = new_socket();
    heard_ = heard_ && name_.size() <= longest_name;
    if (!heard_) return;
    const Address address(name_);
    const char rung = 0;
    // A full queue (EAGAIN) means that the other one has rings to hear.
    heard_ = ::sendto(from, &rung, 1, MSG_NOSIGNAL, address.get(), address.length) == 1 ||
             errno == EAGAIN;
}

}  // namespace turbidite
