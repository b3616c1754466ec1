// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where grains are and go, against what their program says (docs/write-an-adapter.md). Positions
// and orientations are the program's own; these rules hold them to its velocities:
//
//     initialise   the grains of the population, where they are and as they move
//     motion       positions and orientations of the last state
//     state        q^{n+1} = q^n + dt U, and the orientation turned by dt omega
//     prescribed   a grain whose motion the case gives keeps its velocity, or that of
//                  run.grain_motions
//     removed      a grain leaves where a side is free and it was at that side
//
// U is U^{n+1}, or U^{n+4/5} where grains may move with the velocities of their contacts
// (coupling.positions: contact, and schemes whose grains solve contacts with the fluid's inertia);
// omega is either of both, too, whichever U is.
//
// What a state may differ from its rule by is round-off. More only for a grain with a contact,
// i.e. one with a contact impulse, or one near enough to others or a wall that impulses may have
// cancelled out:
//
//     one step per window   dt (|U^{n+1} - U^{n+4/5}| + |U^{n+4/5} - U^n|) + overlap: it moves with
//                           a velocity of the window, and may be pushed out of an overlap
//     native sub-steps      5 (dt V + overlap), V the largest speed of all: struck elastically
//                           by much heavier ones a grain has at most 3 V in between, its surface
//                           11/3 V, and q is compared with dt U^{n+1}, one V more
//
// and, with native sub-steps and no fluid, for a free one: dt |U^{n+1} - U^n|.
#pragma once

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

#include "coupler/hub/checks/arrival.hpp"
#include "coupler/hub/checks/grain_roster.hpp"
#include "coupler/output/window_result.hpp"
#include "coupler/protocol/grain_index.hpp"
#include "coupler/protocol/scene/prescribed_motion.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "coupler/protocol/settings.hpp"
#include "coupler/shapes/immersed_bodies.hpp"

namespace turbidite {

/// What all ranks have sent: their grains, and the rank of each.
struct Gathered {
    const Motion& motion;
    const std::vector<int>& owners;
    const Arrival& arrival;
};

/// Every check throws PhysicsRefused naming sender, grain, quantity, both values and window.
class MotionRule {
 public:
    MotionRule(const Settings& settings, const ShapeTable& shapes,
               const std::vector<GrainState>& population);

    /// What the grains program said of itself: `native_substeps`.
    void expect_substeps(bool native) { substeps_ = native; }
    /// The scheme sends responses of the fluid, with which contacts are final.
    void expect_responses(bool sent) { with_contact_velocity_ = with_contact_velocity_ || sent; }

    void check_start(const std::vector<Leaver>& leavers, const Gathered& initial);
    void check_motion(const Window& window, const Motion& before, const Gathered& motion);

    /// `result` has the last motion and the kicks of the window, both empty without a fluid.
    MotionDefect check_state(const Window& window, const Motion& before, const WindowResult& result,
                             const std::vector<Leaver>& leavers, const Gathered& state);

 private:
    struct Grain;   ///< one grain in the messages of a window
    struct Limits;  ///< of a window

    /// From where a velocity takes a grain [m].
    struct Defect {
        double apart = 0.0;
        double turn = 0.0;  ///< on its circumference
        double larger() const { return std::max(apart, turn); }
    };

    void check_given(const Window& window, const Gathered& sent) const;
    void check_leavers(const std::vector<Leaver>& leavers, const Motion& before,
                       const Arrival& arrival, const Limits& limits) const;
    Defect defect(const Grain& grain, const Twist& rates, double step) const;
    double smallest_defect(const Grain& grain, double step) const;
    bool has_moved_with_its_kick(const Grain& grain, const Kicks& kicks, double step) const;
    std::string text(const Grain& grain, double found, double can, double step) const;
    Limits limits(const Window& window, const Motion& before, const Motion& contact,
                  const Motion& state) const;
    double allowed_alone(const Grain& grain, double step) const;
    double allowed(const Grain& grain, const Motion& before, const Limits& limits);
    bool is_pushed(const Grain& grain, const Limits& limits) const;
    bool may_touch(const GrainState& grain, const Motion& before, double reach) const;
    double distance_to_free_side(const Vec3& position) const;
    Vec3 from_to(const Vec3& from, const Vec3& to) const;
    double same_place() const { return round_off * run_.diameter; }
    bool is_same_rate(const Vec3& expected, const Vec3& found, double scale) const;
    void compare(const Gathered& sent, std::size_t at, const GrainState& expected,
                 const std::string& remedy) const;

    /// Of hosts with other units, or which keep positions half a window apart, relative.
    static constexpr double round_off = 1e-9;

    RunValues run_;
    ImmersedBodies bodies_;
    std::vector<GrainState> population_;
    std::unordered_map<GrainId, Twist> held_;
    std::unordered_map<GrainId, std::shared_ptr<const PrescribedMotion>> driven_;
    SideTypes side_types_;
    bool walls_anywhere_ = false;  ///< inside the box, or sides that move
    bool with_contact_velocity_ = false;
    bool substeps_ = false;
    GrainIndex population_index_, before_, contact_;
};

}  // namespace turbidite
