// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Scheme joint with the contact engine: the coupler, the NSCD adapter and a scripted fluid, in
// threads. The fluid is exact or announces a wrong inertia; the motion must be the same.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "coupler/hub/hub.hpp"
#include "coupler/participant/scripted.hpp"
#include "coupler/participant/session.hpp"
#include "coupler/transport/loopback_channel.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "tests/unit/coupler/test_case.hpp"
#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {
namespace {

constexpr double drag = 0.3;
constexpr int windows = 80;
constexpr double step = 0.02;

Settings heap_settings() {
    Settings s = test_settings("joint");
    s.set("grains.adapter", std::string("standalone-nscd"));
    s.set("coupling.positions", std::string("corrected"));
    s.set("coupling.tolerance", 1e-8);
    s.set("coupling.iterations", std::int64_t{40});
    set_contact_keys(s);
    s.set("contact.solver", std::string("nlgs"));
    s.set("run.step", step);
    s.set("run.windows", std::int64_t{windows});
    s.set("run.output_every", std::int64_t{windows});
    s.set("run.size_x", 4.2);
    return s;
}

/// Four columns of three discs above the floor of a narrow box, staggered so that they support each
/// other.
std::vector<GrainState> heap() {
    std::vector<GrainState> grains;
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 4; ++k) {
            GrainState grain;
            grain.id = 10 * row + k;
            grain.radius = 0.5;
            grain.density = 1.5;
            grain.position = {0.52 + 1.03 * k + (row % 2 ? 0.06 : 0.0), 0.55 + 1.02 * row, 0.0};
            grains.push_back(grain);
        }
    return grains;
}

struct Result {
    RunStatus status;
    std::vector<Vec3> positions;
};

template <class Adapter>
void live(Adapter& adapter, Channel& channel) {
    const auto session = make_session(adapter, channel, {0, 1, "a.log", "0123456789abcdef"});
    for (bool going = session->start(); going; going = session->step()) {
    }
}

Result settle(double inertia_error) {
    const TestFolder folder("joint-heap");
    auto [grains, grains_ends] = LoopbackChannel::connect(1);
    auto [fluid, fluid_ends] = LoopbackChannel::connect(1);
    NscdAdapter nscd;
    ScriptedFluid scripted(drag);
    scripted.misjudge_inertia(inertia_error);
    std::thread grains_thread([&] { live(nscd, *grains_ends[0]); });
    std::thread fluid_thread([&] { live(scripted, *fluid_ends[0]); });
    Result result;
    {
        Hub hub({heap_settings(), {{"disc", {}}}, heap()}, folder.files(), *grains, fluid.get(),
                find_scheme("joint"));
        result.status = hub.run();
    }
    grains_thread.join();
    fluid_thread.join();
    EXPECT_EQ(result.status.code, ExitCode::done) << result.status.reason;
    result.positions = std::as_const(nscd).bodies().position;
    return result;
}

// The properties of the scheme: nothing overlaps (the start is free of overlap and positions follow
// admissible velocities, so only the contact tolerance is left), momentum balances to rounding, and
// fluid and contacts agree in every window.
TEST(JointHeap, AnExactFluidSettlesItInOneRoundPerWindow) {
    const RunMaxima maxima = settle(0.0).status.statistics.maxima;
    EXPECT_LT(maxima.penetration, 1e-9);
    EXPECT_LT(maxima.grain_balance, 1e-12);
    EXPECT_EQ(maxima.unconverged_windows, 0);
    ASSERT_TRUE(maxima.joint);
    EXPECT_EQ(maxima.joint->rounds, 1);
    EXPECT_LT(maxima.joint->mismatch, 1e-13);
}

// Velocities agree to 1e-8 u_c in each of 80 windows of 0.02: positions may differ by 1e-8 * 1.6
// times the amplification by impacts; 1e-6 is far below the motion (a fall of 0.05 D).
TEST(JointHeap, AnApproximateFluidGivesTheSameMotion) {
    const Result exact = settle(0.0);
    for (const double error : {0.1, -0.1}) {
        const Result rounds = settle(error);
        EXPECT_LT(rounds.status.statistics.maxima.penetration, 1e-9);
        EXPECT_LT(rounds.status.statistics.maxima.grain_balance, 1e-12);
        EXPECT_GT(rounds.status.statistics.maxima.joint->rounds, 2);
        EXPECT_EQ(rounds.status.statistics.maxima.joint->unconverged_windows, 0);
        for (std::size_t i = 0; i < exact.positions.size(); ++i)
            for (int axis = 0; axis < 2; ++axis)
                EXPECT_NEAR(rounds.positions[i][axis], exact.positions[i][axis], 1e-6);
    }
}

}  // namespace
}  // namespace turbidite
