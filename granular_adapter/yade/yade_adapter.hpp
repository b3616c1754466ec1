// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact engine with its bodies in YADE: positions and velocities are read from YADE's bodies
// before each contact problem and written back after the move. Whatever a user's script does to a
// body in between takes effect.
#pragma once

#include <boost/python/object.hpp>
#include <string>

#include "coupler/participant/adapter.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "granular_adapter/yade/bodies/body_exchange.hpp"

namespace turbidite::yade {

class YadeAdapter final : public GrainsAdapter {
 public:
    /// `scene` is the Python object that creates and erases YADE's bodies. create(settings, grains)
    /// returns their states and turns (turn.hpp; None for discs); erase(ids) removes bodies by
    /// grain id; side_states() and create_plates(half lengths) return the states of the walls of
    /// the box and inside it. complete() is called when all bodies are in place;
    /// begin_window(index, moved) before each contact solve, with the id of a grain that was moved
    /// by others, or None.
    YadeAdapter(boost::python::object scene, std::string yade_version);

    /// Folder for contact.dump_interval; to be set before initialise().
    void set_run_folder(const std::string& folder) { engine_.set_run_folder(folder); }

    Hello describe() const override { return engine_.describe(); }
    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override;
    Motion advance(const Window& window, const std::vector<FreeResponse>& responses) override;
    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override;
    /// With what others have changed in YADE since the last window.
    SavedState save() const override;
    void restore(const SavedState& state) override;

    /// Contact memory under the ids of YADE's bodies, for scenes saved by YADE.
    std::vector<char> contacts();

 private:
    void name_bodies();
    void begin_window(const Window& window);
    void write_bodies();
    void erase_leavers(const std::vector<GrainId>& in_scene);

    boost::python::object scene_;
    mutable NscdAdapter engine_;  ///< save() reads bodies into it, as the next window would
    nscd::KeyNames names_;        ///< of grains and walls in YADE
    BodyExchange exchange_;
    BodyStates sides_;   ///< walls of the box in YADE, for display and recorders
    BodyStates plates_;  ///< walls inside the box in YADE
};

}  // namespace turbidite::yade
