// SPDX-License-Identifier: GPL-2.0-or-later
//
// The adapter on all ranks of the test against the same on one rank.
#include <gtest/gtest.h>

#include <map>

#include "granular_adapter/md/md_adapter.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "tests/unit/lammps/discs_case.hpp"

namespace turbidite::lammps {
namespace {

const ShapeTable discs = {{"disc", {}}};
constexpr double dt = 0.01;

Settings box(bool wet) {
    Settings settings = box_settings();
    settings.set("fluid.enabled", wet);
    if (!wet) settings.set("run.fluid_density", 0.0), settings.set("run.viscosity", 0.0);
    settings.set("domain.right", std::string("free"));
    settings.set("coupling.md_hold", true);
    settings.set("run.step", dt);
    settings.set("run.md_substeps", std::int64_t{20});
    settings.set("run.md_frequency", 300.0), settings.set("run.md_damping", 0.3);
    settings.set("contact.md_substeps", 20.0);
    return settings;
}

/// Grains by id, collected from all ranks of a communicator.
using Crowd = std::map<GrainId, GrainState>;

Crowd collected(const std::vector<GrainState>& mine, MPI_Comm communicator) {
    int ranks = 1, count = int(mine.size() * sizeof(GrainState));
    MPI_Comm_size(communicator, &ranks);
    std::vector<int> counts(ranks), first(ranks, 0);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
    for (int r = 1; r < ranks; ++r) first[r] = first[r - 1] + counts[r - 1];
    std::vector<GrainState> all((first.back() + counts.back()) / sizeof(GrainState));
    MPI_Allgatherv(mine.data(), count, MPI_BYTE, all.data(), counts.data(), first.data(), MPI_BYTE,
                   communicator);
    Crowd crowd;
    for (const GrainState& grain : all)
        EXPECT_TRUE(crowd.emplace(grain.id, grain).second) << "grain " << grain.id << " twice";
    return crowd;
}

/// A heap of grains that falls to the right, in which they collide and cross from rank to rank.
std::vector<GrainState> heap() {
    std::vector<GrainState> grains;
    for (int row = 0; row < 5; ++row)
        for (int k = 0; k < 6; ++k) {
            GrainState grain = grain_at(9'000'000'000'000 - 7 * row - k,
                                        0.502 + 1.01 * k + 0.5 * (row % 2), 0.502 + 0.9 * row);
            grain.velocity = {0.5 * row, 0.0, 0.0};
            grains.push_back(grain);
        }
    return grains;
}

/// An adapter on the ranks of a communicator, of which each begins with a part of the grains.
class Party {
 public:
    Party(MPI_Comm communicator, const Settings& settings, const std::vector<GrainState>& grains)
        : communicator_(communicator), adapter_("lammps-md", host_) {
        host_.join(communicator);
        int rank = 0, ranks = 1;
        MPI_Comm_rank(communicator, &rank);
        MPI_Comm_size(communicator, &ranks);
        std::vector<GrainState> share;
        for (std::size_t i = 0; i < grains.size(); ++i)
            if (int(i) % ranks == rank) share.push_back(grains[i]);
        mine_ = adapter_.initialise(settings, discs, share).grains;
        own_ = ids();
    }

    /// Plays a window; `kick` gives each grain its velocity.
    template <class Kicker>
    void play(std::int64_t n, Kicker kick) {
        const Window window{n, double(n) * dt, dt, n % 2 == 0};
        const Motion sent = adapter_.advance(window, {});
        sent_ = sent.grains;
        std::vector<Kick> kicks;
        for (const GrainState& grain : sent.grains) kick(grain, kicks);
        const Motion moved = adapter_.apply_kick(window, kicks);
        mine_ = moved.grains;
        removed += moved.report.removed;
        if (moved.contacts) contacts += moved.contacts->size(), listed_ = *moved.contacts;
        for (const GrainState& grain : mine_) arrived += own_.count(grain.id) == 0;
        own_ = ids();
    }

    Crowd now() const { return collected(mine_, communicator_); }
    Crowd sent() const { return collected(sent_, communicator_); }

    /// Sum over all ranks of the normal impulses [N s] in the last list of contacts.
    double normal_impulses() const {
        double mine = 0.0, all = 0.0;
        for (const ContactRecord& contact : listed_) mine += dot(contact.impulse, contact.normal);
        MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, communicator_);
        return all;
    }

    template <class T>
    T total(T mine) const {
        T all = mine;
        MPI_Allreduce(&mine, &all, 1, MPI_INT64_T, MPI_SUM, communicator_);
        return all;
    }

    MdAdapter& adapter() { return adapter_; }

    std::int64_t removed = 0, arrived = 0, contacts = 0;

 private:
    std::map<GrainId, bool> ids() const {
        std::map<GrainId, bool> result;
        for (const GrainState& grain : mine_) result[grain.id] = true;
        return result;
    }

    MPI_Comm communicator_;
    LammpsMdHost host_;
    MdAdapter adapter_;
    std::vector<GrainState> mine_, sent_;
    std::vector<ContactRecord> listed_;
    std::map<GrainId, bool> own_;
};

void no_fluid(const GrainState&, std::vector<Kick>&) {}

/// Slows every grain down a little and holds an impulse.
void drag(const GrainState& grain, std::vector<Kick>& kicks) {
    Kick kick;
    kick.id = grain.id;
    kick.velocity = {0.999 * grain.velocity[0], 0.999 * grain.velocity[1], 0.0};
    kick.angular_velocity = {0.0, 0.0, 0.99 * grain.angular_velocity[2]};
    kick.multiplier_impulse = {1e-4 * double(grain.id % 100), 2e-4, 0.0};
    kick.multiplier_angular_impulse = {0.0, 0.0, 1e-5 * double(grain.id % 100)};
    kicks.push_back(kick);
}

void expect_near(const Crowd& a, const Crowd& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [id, grain] : a) {
        ASSERT_EQ(b.count(id), 1u) << id;
        const GrainState& other = b.at(id);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(grain.position[axis], other.position[axis], tolerance) << id;
            EXPECT_NEAR(grain.velocity[axis], other.velocity[axis], tolerance) << id;
            EXPECT_NEAR(grain.angular_velocity[axis], other.angular_velocity[axis], tolerance);
            EXPECT_NEAR(grain.orientation[axis], other.orientation[axis], tolerance) << id;
            EXPECT_NEAR(grain.contact_impulse[axis], other.contact_impulse[axis], tolerance) << id;
            EXPECT_NEAR(grain.announced_impulse[axis], other.announced_impulse[axis], tolerance);
        }
    }
}

int ranks_of_world() {
    int ranks = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    return ranks;
}

// Sums of forces are taken in another order, and collisions let rounding grow: 1e-8 after 60
// windows, in which grains cross from rank to rank.
TEST(Ranks, TheNumberOfRanksChangesNothing) {
    for (const bool wet : {false, true}) {
        Party alone(MPI_COMM_SELF, box(wet), heap()), together(MPI_COMM_WORLD, box(wet), heap());
        expect_near(alone.now(), together.now(), 1e-14);
        for (std::int64_t n = 0; n < 60; ++n) {
            alone.play(n, wet ? drag : no_fluid);
            together.play(n, wet ? drag : no_fluid);
            expect_near(alone.sent(), together.sent(), 1e-8);
            expect_near(alone.now(), together.now(), 1e-8);
            // Forces change by as much as places over a time of 1/k.
            EXPECT_NEAR(alone.normal_impulses(), together.normal_impulses(), 1e-6);
            if (testing::Test::HasFailure()) return;
        }
        EXPECT_GT(alone.normal_impulses(), 1e-3);
        EXPECT_EQ(together.total(together.contacts), alone.contacts);
        EXPECT_GT(alone.contacts, 100);
        EXPECT_EQ(alone.arrived, 0);
        if (ranks_of_world() > 1) {
            EXPECT_GT(together.total(together.arrived), 0);
        }
    }
}

Settings cyclic_box() {
    return cyclic(box(true), "domain.left", "domain.right");
}

/// At the right side of that box, so that it falls across it.
std::vector<GrainState> heap_at_the_seam() {
    const double shift = cyclic_box().real("run.size_x") - 6.5;
    std::vector<GrainState> grains = heap();
    for (GrainState& grain : grains) grain.position[0] += shift;
    return grains;
}

// The grains of the last rank meet those of the first, and change places with them.
TEST(Ranks, TheNumberOfRanksChangesNothingAcrossCyclicSides) {
    const Settings settings = cyclic_box();
    const std::vector<GrainState> grains = heap_at_the_seam();
    Party alone(MPI_COMM_SELF, settings, grains), together(MPI_COMM_WORLD, settings, grains);
    for (std::int64_t n = 0; n < 60; ++n) {
        alone.play(n, drag), together.play(n, drag);
        expect_near(alone.sent(), together.sent(), 1e-10);
        expect_near(alone.now(), together.now(), 1e-10);
        EXPECT_NEAR(alone.normal_impulses(), together.normal_impulses(), 1e-6);
        if (testing::Test::HasFailure()) return;
    }
    std::int64_t across = 0;
    for (const auto& [id, grain] : alone.now()) across += grain.position[0] < 3.0;
    EXPECT_GT(across, 3);
    EXPECT_EQ(alone.now().size(), grains.size());
    EXPECT_EQ(together.total(together.contacts), alone.contacts);
}

TEST(Ranks, GrainsPastAFreeSideAreRemovedWhereverTheyAre) {
    Party alone(MPI_COMM_SELF, box(false), heap()), together(MPI_COMM_WORLD, box(false), heap());
    for (std::int64_t n = 0; n < 600; ++n) alone.play(n, no_fluid), together.play(n, no_fluid);
    EXPECT_GT(alone.removed, 3);
    EXPECT_GT(together.total(together.removed), 3);
    EXPECT_EQ(together.now().size(), heap().size() - std::size_t(together.total(together.removed)));
}

void expect_to_go_on(const Settings& settings, const std::vector<GrainState>& grains) {
    Party whole(MPI_COMM_WORLD, settings, grains), second(MPI_COMM_WORLD, settings, grains);
    for (std::int64_t n = 0; n < 20; ++n) whole.play(n, drag);
    second.adapter().restore(whole.adapter().save());
    // A state that has made no step is as good as one that has.
    second.adapter().restore(second.adapter().save());
    for (std::int64_t n = 20; n < 40; ++n) {
        whole.play(n, drag), second.play(n, drag);
        expect_near(whole.now(), second.now(), 1e-11);
    }
}

TEST(Ranks, ARestoredRunGoesOn) {
    expect_to_go_on(box(true), heap());
}

// One that has passed a free side by less than its radius is in the state as well.
TEST(Ranks, ARestoredRunGoesOnWhileAGrainLeaves) {
    const double side = box(false).real("run.size_x");
    for (const double beyond : {-0.1, 0.1, 0.3}) {
        GrainState leaving = grain_at(3, side + beyond, 2.0);
        leaving.velocity = {1.0, 0.0, 0.0};
        std::vector<GrainState> grains = heap();
        grains.push_back(leaving);
        expect_to_go_on(box(true), grains);
    }
}

TEST(Ranks, ARestoredRunGoesOnAcrossCyclicSides) {
    expect_to_go_on(cyclic_box(), heap_at_the_seam());
}

// A grain flies through the left wall: the rank that owns it refuses to go on. The others would
// wait for it in LAMMPS.
TEST(Ranks, AFailureOfOneRankDoesNotHoldTheOthers) {
    std::vector<GrainState> grains = heap();
    grains[12].velocity[0] = -1000.0;
    Party together(MPI_COMM_WORLD, box(false), grains);
    std::int64_t refused = 0;
    try {
        for (std::int64_t n = 0; n < 3; ++n) together.play(n, no_fluid);
    } catch (const PhysicsRefused& error) {
        refused = 1;
        const std::string what = error.what();
        EXPECT_NE(what.find("beyond the left wall"), std::string::npos) << what;
        EXPECT_NE(what.find("use a larger contact.md_stiffness"), std::string::npos) << what;
    }
    EXPECT_EQ(together.total(refused), 1);
}

// Positions of the protocol are those of the contact engine, also with velocity Verlet.
TEST(Ranks, AGrainThatTouchesNothingMovesAsUnderTheContactEngine) {
    const std::vector<GrainState> one = {grain_at(7, 5.0, 10.0)};
    Party md(MPI_COMM_SELF, box(true), one);
    NscdAdapter nscd;
    nscd.initialise(box(true), discs, one);
    for (std::int64_t n = 0; n < 20; ++n) {
        std::vector<Kick> kicks;
        md.play(n, [&](const GrainState& grain, std::vector<Kick>& list) {
            drag(grain, list);
            kicks = list;
        });
        const Window window{n, double(n) * dt, dt, false};
        nscd.advance(window, {});
        const GrainState wanted = nscd.apply_kick(window, kicks).grains[0];
        const GrainState moved = md.now().at(7);
        for (int axis = 0; axis < 2; ++axis)
            EXPECT_NEAR(moved.position[axis], wanted.position[axis], 1e-13);
        for (int part = 0; part < 4; ++part)
            EXPECT_NEAR(moved.orientation[part], wanted.orientation[part], 1e-13);
    }
}

}  // namespace
}  // namespace turbidite::lammps
