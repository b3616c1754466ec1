// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/yade_adapter.hpp"

#include <algorithm>
#include <boost/python.hpp>
#include <chrono>
#include <utility>

#include "granular_adapter/yade/yade_grains.hpp"

namespace turbidite::yade {

namespace python = boost::python;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

YadeAdapter::YadeAdapter(python::object scene, std::string yade_version)
    : scene_(std::move(scene)), engine_("yade-nscd", "YADE " + yade_version) {}

Motion YadeAdapter::initialise(const Settings& settings, const ShapeTable& shapes,
                               const std::vector<GrainState>& grains) {
    Motion motion = engine_.initialise(settings, shapes, grains);
    const nscd::Bodies& bodies = std::as_const(engine_).bodies();
    states_ = BodyStates(scene_.attr("create")(settings_dict(settings), grain_list(bodies)));
    if (states_.size() != bodies.size())
        throw Failure(ExitCode::participant_failed,
                      "YADE's scene has " + std::to_string(states_.size()) + " grains, the case " +
                          std::to_string(bodies.size()));
    return motion;
}

void YadeAdapter::read_bodies() {
    nscd::Bodies& bodies = engine_.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyMotion motion = states_.read(i);
        bodies.position[i] = motion.position;
        bodies.orientation[i] = motion.orientation;
        bodies.twist[i] = {motion.velocity, motion.angular_velocity};
    }
}

void YadeAdapter::write_bodies() {
    const nscd::Bodies& bodies = std::as_const(engine_).bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        states_.write(i, {bodies.position[i], bodies.orientation[i], bodies.twist[i].velocity,
                          bodies.twist[i].spin});
}

Motion YadeAdapter::advance(const Window& window, const std::vector<FreeResponse>& responses) {
    const auto start = Clock::now();
    read_bodies();
    const double reading = seconds_since(start);
    Motion motion = engine_.advance(window, responses);
    motion.report.wall_seconds += reading;
    return motion;
}

Motion YadeAdapter::apply_kick(const Window& window, const std::vector<Kick>& kicks) {
    const std::vector<GrainId> before = std::as_const(engine_).bodies().id;
    Motion motion = engine_.apply_kick(window, kicks);
    const auto start = Clock::now();
    erase_leavers(before);
    write_bodies();
    motion.report.wall_seconds += seconds_since(start);
    return motion;
}

void YadeAdapter::erase_leavers(const std::vector<GrainId>& before) {
    const std::vector<GrainId>& gone = engine_.removed();
    if (gone.empty()) return;
    std::vector<std::uint8_t> mask;
    for (const GrainId id : before)
        mask.push_back(std::find(gone.begin(), gone.end(), id) == gone.end());
    states_.keep(mask);
    python::list ids;
    for (const GrainId id : gone) ids.append(id);
    scene_.attr("erase")(ids);
}

void YadeAdapter::restore(const SavedState& state) {
    engine_.restore(state);
    write_bodies();
}

}  // namespace turbidite::yade
