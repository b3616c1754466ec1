// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/transport/doorbell.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

namespace turbidite {
namespace {

constexpr double long_sleep = 20.0;  // [s]: whoever sleeps it has not been woken

std::string name_of(const char* test) {
    return std::string("turbidite/test/") + test + "/" + std::to_string(getpid());
}

TEST(Doorbell, WakesASleeper) {
    Doorbell bell;
    ASSERT_TRUE(bell.hang(name_of("sleeper")));
    std::thread visitor([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        BellButton(name_of("sleeper")).ring();
    });
    EXPECT_TRUE(bell.sleep(long_sleep));
    visitor.join();
}

TEST(Doorbell, KeepsRingsForTheNextSleepAndOnlyForThatOne) {
    Doorbell bell;
    ASSERT_TRUE(bell.hang(name_of("kept")));
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
    EXPECT_TRUE(first.hang(name_of("taken")));
    EXPECT_FALSE(second.hang(name_of("taken")));
    EXPECT_FALSE(third.hang(std::string(101, 'x')));
    BellButton(name_of("taken")).ring();
    EXPECT_FALSE(second.sleep(1e-3));
    EXPECT_FALSE(third.sleep(1e-3));
    EXPECT_TRUE(first.sleep(long_sleep));
}

TEST(Doorbell, IsFreeAgainAfterItsEnd) {
    EXPECT_TRUE(Doorbell().hang(name_of("again")));
    EXPECT_TRUE(Doorbell().hang(name_of("again")));
}

}  // namespace
}  // namespace turbidite
