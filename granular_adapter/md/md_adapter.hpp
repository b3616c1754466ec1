// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Molecular dynamics as a grains adapter: step 4 of the splitting in sub-steps of a host, with the
// inertia cM and the submerged weight of shapes/immersed_body, so that contact forces are the
// physical ones. Per window of length dt, k sub-steps of delta = dt/k:
//
//     advance     loads J_h/dt, k sub-steps: x, U^n -> x', U^{n+4/5}; announces J_h
//     apply_kick  U^{n+1} from the fluid, which solved cM (U^{n+1} - U^{n+4/5}) = dt lambda - J_h
//
// J_h is the multiplier impulse of the last window (zero in the first), its moment alike, and zero
// throughout with `coupling.md_hold: false`. Held, the fluid acts on a grain while it touches
// others and not in between, and what step 5 still has to change is small.
//
// The position of the protocol is that of the contact engine, which is half a window ahead of the
// velocity; the host's is half a sub-step ahead (both are leap-frogs), so
//
//     q = x + (dt - delta)/2 U
//
// A grain that touched nothing is moved with the kick as if it had acted all along,
//
//     x^{n+1} = x' + (dt + delta)/2 (U^{n+1} - U^{n+4/5})
//
// which makes q^{n+1} = q^n + dt U^{n+1} exactly, J_h held or not; orientations alike. One that
// touched stays where its contacts put it: the kick moving it would press it into its neighbours
// behind the springs' back.
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

namespace turbidite {

class MdAdapter final : public GrainsAdapter {
 public:
    /// The host outlives the adapter.
    MdAdapter(std::string adapter_name, MdHost& host);

    Hello describe() const override;

    /// Throws std::invalid_argument naming a cyclic side or a shape that is no disc.
    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override;

    /// Once per window. Contact impulses are what the host summed up in windows with output, and
    /// follow from the change of momentum in the others. Throws std::runtime_error when responses
    /// of the fluid come.
    Motion advance(const Window& window, const std::vector<FreeResponse>& responses) override;

    /// One kick per grain, or none at all when the case has no fluid.
    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override;

    SavedState save() const override;
    void restore(const SavedState& state) override;

 private:
    /// J_h and its moment of one grain [N s], [N m s].
    struct Held {
        Vec3 impulse{};
        Vec3 angular_impulse{};
    };

    double lead() const;
    Substeps substeps(const Window& window) const;
    Load load(std::size_t i, double dt) const;
    void book_contacts(const nscd::Bodies& before, const SubstepReport& run, double dt);
    void take_kicks(const Window& window, const std::vector<Kick>& kicks);
    void remove_leavers();
    nscd::Bodies at_protocol_positions() const;
    Motion motion(const nscd::Bodies& bodies) const;

    std::string adapter_name_;
    MdHost& host_;
    RunValues run_;
    bool hold_ = true;
    std::int64_t substep_count_ = 1;  ///< k
    std::vector<Border> borders_;
    nscd::Bodies bodies_;  ///< at the host's positions
    std::vector<Held> held_;
    std::vector<std::uint8_t> touched_;                   ///< in this window
    std::optional<std::vector<ContactRecord>> contacts_;  ///< of this window, if it has output
    bool advanced_ = false;
    ContactReport report_;  ///< of this window
};

}  // namespace turbidite
