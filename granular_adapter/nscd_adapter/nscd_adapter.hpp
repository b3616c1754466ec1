// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact engine as a grains adapter: step 4 of the splitting (Topin 2011, Eqs. 16-19) with the
// immersed inertia of shapes/immersed_body, then motion with the velocities chosen by
// `coupling.positions`. If the fluid has sent responses, these are the free velocities and
// inertias, advance may be repeated within a window, and grains move with the contact velocities.
// Hosts such as YADE wrap this class: they overwrite bodies() before a call and read them after it.
//
// Walls inside the box (run.walls) are plates with grains on both sides. They and the sides of the
// box are at rest or move as run.wall_motions prescribes. Grains with prescribed motion keep their
// velocity, or follow run.grain_motions. For the materials of grains and their pairs see
// contact_settings.hpp.
//
// On several ranks (share_with) grains go to the ranks of their cells (nscd/ranks): what
// initialise, advance and apply_kick return are the grains that this rank has then. A check that
// fails on one rank is known to all, which go on without exchanging anything until the coupler ends
// the run.
//
// Reads: contact.*, coupling.positions, domain.{left,right,bottom,top,front,back}, fluid.enabled,
// fluid.hydrodynamic_radius, run.*. Gravity acts along -y; sides as in borders.hpp.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupler/participant/adapter.hpp"
#include "coupler/protocol/run_values.hpp"
#include "granular_adapter/grains/borders.hpp"
#include "granular_adapter/grains/wall_motions.hpp"
#include "granular_adapter/nscd/engine/engine.hpp"
#include "granular_adapter/nscd_adapter/problem_dumps.hpp"

namespace turbidite {

class NscdAdapter final : public GrainsAdapter {
 public:
    /// Names by which the adapter identifies itself; a host passes its own ("yade-nscd", "YADE
    /// 2023.02a").
    explicit NscdAdapter(std::string adapter_name = "standalone-nscd",
                         std::string host_code = "none");

    /// Folder for contact.dump_interval, by default the working folder; to be set before
    /// initialise().
    void set_run_folder(std::filesystem::path folder) { run_folder_ = std::move(folder); }

    /// The ranks of the run; to be called before initialise(). The exchange must outlive the
    /// adapter.
    void share_with(nscd::RankExchange& ranks) { ranks_ = &ranks; }

    Hello describe() const override;
    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override;
    /// One response per grain, or none. Throws std::runtime_error naming a grain with two
    /// responses, or with none while others have one; PhysicsRefused if an effective inertia is not
    /// positive definite. A call repeated before the kick starts from t^n again, with the impulses
    /// found so far.
    Motion advance(const Window& window, const std::vector<FreeResponse>& responses) override;

    /// One kick per grain, or none if the case has no fluid. Throws std::runtime_error naming a
    /// grain with no kick or two, or an unknown grain.
    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override;

    SavedState save() const override;

    /// To be called after initialise() with the same settings.
    void restore(const SavedState& state) override;

    /// The grains of all ranks are shared out evenly (coupler/protocol/even_shares.hpp).
    void restore_from(const std::vector<SavedState>& of_ranks) override;

    /// Between two calls a host may overwrite anything in its bodies: positions, velocities, loads,
    /// flags.
    nscd::Bodies& bodies() { return engine().bodies(); }
    const nscd::Bodies& bodies() const { return engine().bodies(); }

    /// Gives access to the contacts of the last window, for the host's own output.
    const nscd::Engine& engine() const;
    nscd::Engine& engine();

    /// Contact memory of the last window as bytes, for hosts that store bodies in their own files:
    /// take_over_contacts() in the new process makes its first window start from it.
    std::vector<char> contact_memory() const { return engine().save_memory(); }
    void take_over_contacts(const std::vector<char>& bytes) { engine().restore_memory(bytes); }

 private:
    enum class Positions { corrected, contact };
    struct Names {
        std::string adapter, host_code;
    };
    /// Motions that the case prescribes.
    struct Driven {
        std::vector<Moved> walls, grains;
    };
    struct WindowTwists {
        std::vector<Twist> start;    ///< U^n
        std::vector<Twist> contact;  ///< U^{n+4/5}; empty after the kick
    };
    /// By the last kick.
    struct Removed {
        std::vector<GrainId> own, of_all_ranks;
    };

    static Positions parse_positions(const std::string& text);
    nscd::EngineSettings engine_settings(const Settings& settings) const;
    template <class Check>
    void agree(Check check);
    bool on_any_rank(bool here) const;
    void begin_round();
    nscd::StepReport solve_contacts(const Window& window,
                                    const std::vector<FreeResponse>& responses);
    void remove_leavers();
    Motion motion() const;

    nscd::RankExchange* ranks_ = nullptr;  ///< none: one rank
    bool broken_ = false;                  ///< a check has failed on another rank
    Names names_;
    std::filesystem::path run_folder_ = ".";
    ProblemDumps dumps_;
    RunValues run_;
    bool answered_ = false;  ///< the fluid has sent responses in this window
    Positions positions_ = Positions::corrected;
    std::vector<Border> borders_;
    Driven driven_;
    std::unique_ptr<nscd::Engine> engine_;
    WindowTwists twists_;
    Removed removed_;
    std::optional<GrainId> light_;  ///< the first grain that is not denser than the fluid
    ContactReport report_;          ///< of this window
};

}  // namespace turbidite
