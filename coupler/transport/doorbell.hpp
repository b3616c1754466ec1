// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Wakes a process of the same host that sleeps until a frame arrives. A ring says that something
// has been sent and carries nothing: a process without a bell, or on another host, finds its frames
// when it polls again (Patience). Bells are datagram sockets of Linux' abstract namespace, which
// leave no file behind when a process dies. Valid C++17.
#pragma once

#include <string>
#include <utility>

namespace turbidite {

class Doorbell {
 public:
    /// The one of this process.
    static Doorbell& own();

    /// Nobody can ring before install().
    Doorbell() = default;
    ~Doorbell();
    Doorbell(const Doorbell&) = delete;
    Doorbell& operator=(const Doorbell&) = delete;

    /// From now on others can ring. Returns false if nobody can, since there is a bell of this name
    /// already, or the name is longer than 100 characters. A bell keeps its first name.
    bool install(const std::string& name);

    /// Sleeps until somebody rings, `seconds` at most. Returns whether a process of this user has,
    /// also before this call; rings of others end the sleep and count for nothing. Returns however
    /// often somebody rings.
    bool sleep(double seconds);

 private:
    int socket_ = -1;
};

/// Rings the bell of a process.
class BellButton {
 public:
    explicit BellButton(std::string name) : name_(std::move(name)) {}

    /// Returns at once. After a ring that nobody could hear, does nothing any more: bells are
    /// installed before the first ring.
    void ring();

    bool heard() const { return heard_; }

 private:
    std::string name_;
    bool heard_ = true;
};

}  // namespace turbidite
