// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/yade_adapter.hpp"

#include <algorithm>
#include <boost/python.hpp>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "granular_adapter/yade/engine_memory.hpp"
#include "granular_adapter/yade/yade_grains.hpp"

namespace turbidite::yade {

namespace python = boost::python;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Rotations (w, x, y, z); None for discs.
std::vector<Turn> turns_of(const python::object& list) {
    std::vector<Turn> turns(static_cast<std::size_t>(python::len(list)));
    for (std::size_t i = 0; i < turns.size(); ++i) {
        const python::object q = list[i];
        if (q.is_none()) continue;
        turns[i].planar = true;
        for (int k = 0; k < 4; ++k) turns[i].rotation[k] = python::extract<double>(q[k]);
    }
    return turns;
}

bool is_plate(const nscd::Wall& wall) {
    return wall.form == nscd::WallForm::flat && has_ends(wall);
}

/// Cylinders, cones, rings and rectangles of space are walls of the contact engine alone.
bool is_in_the_scene(const nscd::Wall& wall) {
    return wall.form == nscd::WallForm::flat;
}

/// Half lengths of the walls inside the box [m].
python::list plate_list(const std::vector<nscd::Wall>& walls) {
    python::list list;
    for (const nscd::Wall& wall : walls)
        if (is_plate(wall)) list.append(wall.half_length);
    return list;
}

void demand_all_sides(std::size_t created, const std::vector<nscd::Wall>& walls) {
    const auto inner = std::count_if(walls.begin(), walls.end(), nscd::has_ends);
    const std::size_t sides = walls.size() - static_cast<std::size_t>(inner);
    if (created != sides)
        throw std::logic_error("YADE's scene has " + std::to_string(created) +
                               " walls at sides of the domain, the contact engine " +
                               std::to_string(sides));
}

/// Motion of a plate whose reference position is along x.
BodyMotion plate_motion(const nscd::Wall& wall) {
    return {wall.point,
            // n = (-sin a, cos a) for a plate that is turned by a from the x axis.
            about_z(std::atan2(-wall.normal[0], wall.normal[1])),
            {velocity_at(wall, wall.point), wall.twist.spin}};
}

/// Motion of a side of the box: YADE's wall lies at the coordinate along its axis.
BodyMotion side_motion(const nscd::Wall& wall) {
    int axis = 0;
    while (axis < 2 && std::abs(wall.normal[axis]) < 0.5) ++axis;
    Vec3 place{};
    place[axis] = wall.point[axis];
    return {place, {1.0, 0.0, 0.0, 0.0}, {wall.twist.velocity, {}}};
}

}  // namespace

YadeAdapter::YadeAdapter(python::object scene, std::string yade_version)
    : scene_(std::move(scene)), engine_("yade-nscd", "YADE " + yade_version) {}

Motion YadeAdapter::initialise(const Settings& settings, const ShapeTable& shapes,
                               const std::vector<GrainState>& grains) {
    Motion motion = engine_.initialise(settings, shapes, grains);
    const nscd::Bodies& bodies = std::as_const(engine_).bodies();
    const python::object made =
        scene_.attr("create")(settings_dict(settings), grain_list(bodies, shapes));
    exchange_ = BodyExchange(made[0], turns_of(made[1]), bodies.size());
    sides_ = BodyStates(scene_.attr("side_states")());
    demand_all_sides(sides_.size(), engine_.engine().walls());
    plates_ = BodyStates(scene_.attr("create_plates")(plate_list(engine_.engine().walls())));
    write_bodies();
    scene_.attr("complete")();
    return motion;
}

void YadeAdapter::name_bodies() {
    const auto number = [](const python::object& id) { return python::extract<GrainId>(id)(); };
    const python::object bodies = scene_.attr("body_of");
    for (const GrainId id : std::as_const(engine_).bodies().id)
        names_.bodies[id] = number(bodies[id]);
    const python::object sides = scene_.attr("sides"), plates = scene_.attr("plates");
    int side = 0, plate = 0;
    for (const nscd::Wall& wall : std::as_const(engine_).engine().walls())
        if (is_plate(wall))
            names_.walls[wall.key] = number(plates[plate++]);
        else if (is_in_the_scene(wall))
            names_.walls[wall.key] = number(sides[side++]);
}

void YadeAdapter::begin_window(const Window& window) {
    const nscd::Bodies& bodies = std::as_const(engine_).bodies();
    // Compared before reading: what a script has moved since the last window.
    const auto moved = exchange_.moved();
    const python::object grain = moved ? python::object(bodies.id[*moved]) : python::object();
    scene_.attr("begin_window")(window.index, grain);
}

void YadeAdapter::write_bodies() {
    exchange_.write(std::as_const(engine_).bodies());
    std::size_t plate = 0, side = 0;
    for (const nscd::Wall& wall : std::as_const(engine_).engine().walls())
        if (is_plate(wall))
            plates_.write(plate++, plate_motion(wall));
        else if (is_in_the_scene(wall))
            sides_.write(side++, side_motion(wall));
}

Motion YadeAdapter::advance(const Window& window, const std::vector<FreeResponse>& responses) {
    const auto start = Clock::now();
    begin_window(window);
    exchange_.read(engine_.bodies());
    // Reading YADE's bodies is work of the grains program as well.
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

/// Erases the bodies of those grains in the scene that the engine does not have any more.
void YadeAdapter::erase_leavers(const std::vector<GrainId>& in_scene) {
    const std::vector<GrainId>& left = std::as_const(engine_).bodies().id;
    if (left == in_scene) return;
    std::vector<std::uint8_t> mask;
    python::list gone;
    // Grains keep their order.
    std::size_t next = 0;
    for (const GrainId id : in_scene) {
        const bool stays = next < left.size() && left[next] == id;
        mask.push_back(stays);
        if (stays)
            ++next;
        else
            gone.append(id);
    }
    if (next != left.size())
        throw std::runtime_error("grain " + std::to_string(left[next]) +
                                 " of the state is not in YADE's scene any more");
    // Before the scene erases them: states of erased bodies must not be written any more.
    exchange_.keep(mask);
    scene_.attr("erase")(gone);
}

std::vector<char> YadeAdapter::contacts() {
    // Few runs have a script that may save the scene: others need no names.
    if (names_.bodies.empty()) name_bodies();
    return contact_memory(engine_.engine(), &names_);
}

SavedState YadeAdapter::save() const {
    exchange_.read(engine_.bodies());
    return engine_.save();
}

void YadeAdapter::restore(const SavedState& state) {
    const std::vector<GrainId> before = std::as_const(engine_).bodies().id;
    engine_.restore(state);
    // A run that goes on begins with all grains of its case; some may have left before the state.
    erase_leavers(before);
    write_bodies();
}

}  // namespace turbidite::yade
