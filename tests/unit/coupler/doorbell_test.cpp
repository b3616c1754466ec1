// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/transport/doorbell.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

namespace {

/// Called whenever a datagram is taken from a socket, before it is.
std::function<void()> at_every_receive;

template <class Function>
Function* of_libc(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" ssize_t recv(int socket, void* to, size_t size, int flags) {
    if (at_every_receive) at_every_receive();
    return of_libc<ssize_t(int, void*, size_t, int)>("recv")(socket, to, size, flags);
}

extern "C" ssize_t recvmsg(int socket, msghdr* message, int flags) {
    if (at_every_receive) at_every_receive();
    return of_libc<ssize_t(int, msghdr*, int)>("recvmsg")(socket, message, flags);
}

namespace turbidite {
namespace {

constexpr double long_sleep = 20.0;  // [s]: whoever sleeps it has not been woken

std::string name_of(const char* test) {
    return std::string("turbidite/test/") + test + "/" + std::to_string(getpid());
}

TEST(Doorbell, WakesASleeper) {
    Doorbell bell;
    ASSERT_TRUE(bell.install(name_of("sleeper")));
    std::thread visitor([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        BellButton(name_of("sleeper")).ring();
    });
    EXPECT_TRUE(bell.sleep(long_sleep));
    visitor.join();
}

TEST(Doorbell, KeepsRingsForTheNextSleepAndOnlyForThatOne) {
    Doorbell bell;
    ASSERT_TRUE(bell.install(name_of("kept")));
    BellButton visitor(name_of("kept"));
    for (int n = 0; n < 1000; ++n) visitor.ring();  // more than a socket queues
    EXPECT_TRUE(visitor.heard());
    EXPECT_TRUE(bell.sleep(long_sleep));
    EXPECT_FALSE(bell.sleep(1e-3));
}

TEST(Doorbell, OfNobodyIsRungInVain) {
    BellButton visitor(name_of("nobody"));
    EXPECT_TRUE(visitor.heard());
    visitor.ring();
    EXPECT_FALSE(visitor.heard());
}

TEST(Doorbell, WithATakenOrAnOverlongNameStaysSilent) {
    Doorbell first, second, third;
    EXPECT_TRUE(first.install(name_of("taken")));
    EXPECT_FALSE(second.install(name_of("taken")));
    EXPECT_FALSE(third.install(std::string(101, 'x')));
    BellButton(name_of("taken")).ring();
    EXPECT_FALSE(second.sleep(1e-3));
    EXPECT_FALSE(third.sleep(1e-3));
    EXPECT_TRUE(first.sleep(long_sleep));
}

// Whoever rings faster than it is heard would otherwise hold the sleeper for ever.
TEST(Doorbell, RingingWithoutEndEndsASleep) {
    Doorbell bell;
    ASSERT_TRUE(bell.install(name_of("endless")));
    BellButton visitor(name_of("endless"));
    visitor.ring();
    int heard = 0;
    at_every_receive = [&] {
        if (++heard < 100000) visitor.ring();  // where the sleep should have ended long ago
    };
    const bool rung = bell.sleep(long_sleep);
    at_every_receive = nullptr;
    EXPECT_TRUE(rung);
    EXPECT_GT(heard, 0);
    EXPECT_LT(heard, 10000);
}

// The names of bells are no secret on a host. Needs the right to become somebody else.
TEST(Doorbell, RingsOfOtherUsersCountForNothing) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can ring as somebody else";
    constexpr uid_t nobody = 65534;
    Doorbell bell;
    ASSERT_TRUE(bell.install(name_of("stranger")));
    const auto ring_as = [](uid_t user) {
        const pid_t visitor = fork();
        if (visitor == 0) {
            if (user != 0 && setuid(user) != 0) _exit(1);
            BellButton button(std::string("turbidite/test/stranger/") + std::to_string(getppid()));
            button.ring();
            _exit(button.heard() ? 0 : 2);
        }
        int status = 0;
        waitpid(visitor, &status, 0);
        return WEXITSTATUS(status);
    };
    ASSERT_EQ(ring_as(nobody), 0);
    EXPECT_FALSE(bell.sleep(1e-3));
    ASSERT_EQ(ring_as(0), 0);
    EXPECT_TRUE(bell.sleep(long_sleep));
}

TEST(Doorbell, IsFreeAgainAfterItsEnd) {
    EXPECT_TRUE(Doorbell().install(name_of("again")));
    EXPECT_TRUE(Doorbell().install(name_of("again")));
}

}  // namespace
}  // namespace turbidite
