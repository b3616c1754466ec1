// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Molecular dynamics as a grains adapter: step 4 of the splitting in sub-steps of a host, with the
// inertia cM and the submerged weight of shapes/immersed_body, so that contact forces are the
// physical ones. Per window of length dt there are k sub-steps of delta = dt/k:
//
//     advance     loads J_h/dt, k sub-steps: x, U^n -> x', U^{n+4/5}; announces J_h
//     apply_kick  U^{n+1} from the fluid, which solved cM (U^{n+1} - U^{n+4/5}) = dt lambda - J_h
//
// J_h is the multiplier impulse of the last window (zero in the first), with its moment, and always
// zero with `coupling.md_hold: false`. With it, the force of the fluid acts on a grain throughout
// the sub-steps, also during a collision, and the remaining change in step 5 is small.
//
// The position in the protocol is that of the contact engine, half a window ahead of the velocity;
// that of the host is half a sub-step ahead if it is a leap-frog scheme (s = delta), and at the
// time of the velocity if it is velocity Verlet (s = 0), so
//
//     q = x + (dt - s)/2 U
//
// but for grains that this would begin inside others (first_positions.hpp): they are at q, and half
// a window ahead of the case.
//
// A grain without contact in the window is moved as if the kick had acted all along,
//
//     x^{n+1} = x' + (dt + s)/2 (U^{n+1} - U^{n+4/5})
//
// which makes q^{n+1} = q^n + dt U^{n+1} exactly, with or without J_h; orientations likewise. A
// grain with a contact stays at its position after the sub-steps: moving it with the kick would
// push it into its neighbours without any spring force.
//
// Reads: run.*, domain.*, contact.friction, coupling.md_hold, fluid.enabled,
// fluid.hydrodynamic_radius.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/participant/adapter.hpp"
#include "coupler/protocol/run_values.hpp"
#include "granular_adapter/grains/borders.hpp"
#include "granular_adapter/md/md_host.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite {

class MdAdapter final : public GrainsAdapter {
 public:
    /// The host must outlive the adapter.
    MdAdapter(std::string adapter_name, MdHost& host);

    Hello describe() const override;

    /// Throws std::invalid_argument naming a cyclic side or a shape that the host cannot play.
    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override;

    /// In windows with output the contact impulses are those summed by the host; in the others they
    /// follow from the change of momentum if it does not sum them. With responses, of which only
    /// the velocities are used, the window is played again from t^n: each grain holds the impulse
    /// J_h + cM (U - U^{n+4/5}) that would take it to the velocity U if its contacts stayed as they
    /// were (run.repeats_windows). Throws std::runtime_error if there are responses otherwise.
    Motion advance(const Window& window, const std::vector<FreeResponse>& responses) override;

    /// One kick per grain, or none if the case has no fluid.
    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override;

    SavedState save() const override;
    void restore(const SavedState& state) override;

 private:
    /// J_h and its moment of one grain [N s], [N m s].
    struct Held {
        Vec3 impulse{};
        Vec3 angular_impulse{};
    };

    /// Of the present window.
    struct Present {
        SavedState start;                                    ///< if windows may be played again
        std::vector<Quaternion> orientation_at_start;        ///< as it was sent
        std::vector<std::uint8_t> touched;                   ///< whether a grain had a contact
        std::optional<std::vector<ContactRecord>> contacts;  ///< if it has output
        bool advanced = false;
    };

    Motion play(const Window& window);
    void repeat(const Window& window, const std::vector<FreeResponse>& targets);
    double velocity_lag() const;
    double lead() const;
    Substeps substeps(const Window& window) const;
    Load load(std::size_t i, double dt) const;
    void book_contacts(const std::vector<Twist>& before, const SubstepReport& run, double dt);
    void take_kicks(const Window& window, const std::vector<Kick>& kicks);
    template <class Check>
    void agree(Check check);
    void remove_leavers();
    void read(const SavedState& state);
    void follow_migration(nscd::Bodies* sent);
    nscd::Bodies at_protocol_positions() const;
    Motion motion(const nscd::Bodies& bodies) const;

    std::string adapter_name_;
    MdHost& host_;
    RunValues run_;
    bool hold_ = true;
    bool repeats_ = false;            ///< windows may be played again
    std::int64_t substep_count_ = 1;  ///< k
    std::vector<Border> borders_;
    nscd::PeriodicBox box_;
    nscd::Bodies bodies_;  ///< at the host's positions
    std::vector<Held> held_;
    Present present_;
    /// In the first window: bodies whose host position is that of the protocol.
    std::optional<std::vector<std::uint8_t>> ahead_;
    bool broken_ = false;   ///< another rank has failed: nothing may be exchanged with it any more
    ContactReport report_;  ///< of this window
};

}  // namespace turbidite
