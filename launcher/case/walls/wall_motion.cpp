// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/walls/wall_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/scene/plates.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "launcher/case/case_rules.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/case/grains/start_grains.hpp"

namespace turbidite {
namespace {

constexpr const char* prefix = "domain.motions.";

std::string key_of(const std::string& name, const char* part) {
    return prefix + name + "." + part;
}

bool gives(const Settings& s, const std::string& name, const char* part) {
    return s.has(key_of(name, part));
}

double number(const Settings& s, const std::string& name, const char* part) {
    return gives(s, name, part) ? s.real(key_of(name, part)) : 0.0;
}

std::size_t dimension(const Settings& s) {
    return in_space(s) ? 3 : 2;
}

std::vector<double> numbers(const Settings& s, const std::string& name, const char* part) {
    if (!gives(s, name, part)) return std::vector<double>(dimension(s), 0.0);
    return real_list(key_of(name, part), s.text(key_of(name, part)));
}

/// Turns a wall about its pivot.
bool turns(const Settings& s, const std::string& name) {
    return number(s, name, "spin") != 0.0 || number(s, name, "turn") != 0.0;
}

struct Kind {
    const char* name;
    std::vector<const char*> needs;
    std::vector<const char*> may;
    /// Numbers of run.wall_motions, in run units.
    std::vector<double> (*numbers)(const Settings&, const std::string& name, const Scales&);
};

/// Of a turn in space, unit.
Vec3 axis_of(const Settings& s, const std::string& name) {
    if (!gives(s, name, "axis")) return {0.0, 0.0, 1.0};
    const auto given = numbers(s, name, "axis");
    const Vec3 along{given[0], given[1], given[2]};
    // Of any length in the case: the angle alone says how far it turns.
    return along / norm(along);
}

/// Direction times the largest angle from where the wall began [rad], 0 if it does not turn.
Vec3 largest_turn(const Settings& s, const std::string& name) {
    if (number(s, name, "spin") != 0.0) return full_turn * axis_of(s, name);
    // a(t) = A (sin(2 pi t/T + phase) - sin(phase))
    return std::abs(number(s, name, "turn")) *
           (1.0 + std::abs(std::sin(number(s, name, "phase")))) * axis_of(s, name);
}

/// A shift in the form of prescribed_motion.hpp: `X Y ANGLE`, or `X Y Z AX AY AZ`.
std::vector<double> shift(const Settings& s, const std::string& name,
                          const std::vector<double>& way, double unit, double angle) {
    std::vector<double> result;
    for (std::size_t i = 0; i < dimension(s); ++i) result.push_back(way[i] * unit);
    if (dimension(s) == 2) {
        result.push_back(angle);
        return result;
    }
    // A rotation vector: direction times angle [rad].
    for (const double part : axis_of(s, name)) result.push_back(angle * part);
    return result;
}

std::vector<double> constant(const Settings& s, const std::string& name, const Scales& scales) {
    return shift(s, name, numbers(s, name, "velocity"), scales.velocity,
                 // From [u_c] and [1/t_c].
                 number(s, name, "spin") / scales.time);
}

std::vector<double> harmonic(const Settings& s, const std::string& name, const Scales& scales) {
    auto result =
        // From [D]; a turn is an angle in the case as well.
        shift(s, name, numbers(s, name, "amplitude"), scales.diameter, number(s, name, "turn"));
    result.push_back(number(s, name, "period") * scales.time);
    result.push_back(number(s, name, "phase"));
    return result;
}

std::vector<double> table(const Settings& s, const std::string& name, const Scales& scales) {
    const auto rows = numbers(s, name, "table");
    const std::size_t per_row = 1 + dimension(s);
    std::vector<double> result;
    for (std::size_t i = 0; i + per_row <= rows.size(); i += per_row) {
        const std::vector<double> way(rows.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                      rows.begin() + static_cast<std::ptrdiff_t>(i + per_row));
        result.push_back(rows[i] * scales.time);
        for (const double part : shift(s, name, way, scales.diameter, 0.0)) result.push_back(part);
    }
    return result;
}

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> list = {
        {"constant", {}, {"velocity", "spin", "axis"}, constant},
        {"harmonic", {"period"}, {"amplitude", "turn", "phase", "axis"}, harmonic},
        {"table", {"table"}, {}, table},
    };
    return list;
}

const Kind& kind_of(const Settings& s, const std::string& name) {
    const std::string& wanted = s.text(key_of(name, "kind"));
    return *std::find_if(kinds().begin(), kinds().end(),
                         [&](const Kind& kind) { return wanted == kind.name; });
}

bool has(const std::vector<const char*>& list, const std::string& word) {
    return std::any_of(list.begin(), list.end(), [&](const char* w) { return word == w; });
}

std::optional<Objection> bad_table(const Settings& s, const std::string& name) {
    const auto rows = numbers(s, name, "table");
    const std::size_t n = 1 + dimension(s);
    bool good = rows.size() >= n && rows.size() % n == 0 &&
                std::all_of(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(n),
                            [](double first) { return first == 0.0; });
    // d(0) = 0, as of every motion, and times that increase: else the interpolation divides by
    // zero.
    for (std::size_t i = n; good && i < rows.size(); i += n) good = rows[i] > rows[i - n];
    if (good) return std::nullopt;
    if (n == 4)
        return Objection{
            "Rows of time [t_c], x, y, z [D]: the first is 0, 0, 0, 0, and times increase.",
            "Write for example table: [0, 0, 0, 0, 2, -1, 0, 0]."};
    return Objection{"Rows of time [t_c], x, y [D]: the first is 0, 0, 0, and times increase.",
                     "Write for example table: [0, 0, 0, 2, -1, 0]."};
}

CaseProblems check_motion(const Settings& s, const std::string& name, const CaseEntries& entries) {
    if (!gives(s, name, "kind"))
        return {{.source = entries.entries.front().source,
                 .line = 0,
                 .key = key_of(name, "kind"),
                 .value = {},
                 .fault = "is missing",
                 .allowed = "Available: constant, harmonic, table.",
                 .remedy = "Give the kind of motion."}};
    CaseProblems problems;
    const auto object = [&](const std::string& key, const Objection& objection) {
        problems.push_back(problem_with(key, objection, s, entries));
    };
    const Kind& kind = kind_of(s, name);
    // A part whose value has been refused is there.
    for (const char* part : kind.needs)
        if (!gives(s, name, part) && entries.find(key_of(name, part)) == nullptr)
            object(key_of(name, "kind"),
                   {fmt::format("A motion of this kind needs {}.", key_of(name, part)), "Add it."});
    for (const auto& [key, value] : s.entries()) {
        if (key.rfind(prefix + name + ".", 0) != 0) continue;
        const std::string part = key.substr(key.rfind('.') + 1);
        if (part != "kind" && !has(kind.needs, part) && !has(kind.may, part))
            object(key, {fmt::format("A {} motion has no {}.", kind.name, part), "Remove it."});
    }
    if (gives(s, name, "axis") && numbers(s, name, "axis") == std::vector<double>(3, 0.0))
        object(key_of(name, "axis"), {"A direction, of any length but 0.", "Write [0, 1, 0]."});
    if (gives(s, name, "table"))
        if (const auto objection = bad_table(s, name)) object(key_of(name, "table"), *objection);
    return problems;
}

Objection unknown_motion(const Settings& s) {
    return {
        fmt::format(
            "There is no motion of this name below domain.motions; there are {}.",
            motion_names(s).empty() ? "none" : fmt::format("{}", fmt::join(motion_names(s), ", "))),
        "Describe it there, or correct the name."};
}

bool is_known(const Settings& s, const std::string& name) {
    const auto names = motion_names(s);
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_inflow(const Settings& s, const BoxSide& side) {
    return is(s, side.key, "inflow");
}

std::string motion_key(const BoxSide& side) {
    return std::string(side.key) + "_motion";
}

/// Whether a motion leaves a wall normal to this axis in its plane.
bool slides(const Settings& s, const std::string& name, int axis) {
    for (const char* part : {"velocity", "amplitude"})
        if (numbers(s, name, part).at(axis) != 0.0) return false;
    const auto rows = numbers(s, name, "table");
    const std::size_t n = 1 + dimension(s);
    for (std::size_t i = 0; i + n <= rows.size(); i += n)
        if (rows[i + 1 + static_cast<std::size_t>(axis)] != 0.0) return false;
    return true;
}

std::optional<Objection> bad_side(const Settings& s, const BoxSide& side) {
    const std::string& name = s.text(motion_key(side));
    if (!is_known(s, name)) return unknown_motion(s);
    const bool wall = is(s, side.key, "wall");
    if (!wall && !is_inflow(s, side))
        return Objection{fmt::format("Only walls can move, and fluid enters only through inflows, "
                                     "but {} = {}.",
                                     side.key, s.text(side.key)),
                         fmt::format("Use {}: wall or inflow, or remove it.", side.key)};
    if (turns(s, name))
        return Objection{"A side of the box does not turn.", "Remove spin and turn."};
    if (!wall) return std::nullopt;
    if (s.flag("fluid.enabled") && !slides(s, name, side.axis))
        return Objection{
            fmt::format("In a fluid a side slides along itself only: the {} component of its "
                        "motion must be 0.",
                        "xyz"[side.axis]),
            fmt::format("Set it to 0, set fluid.enabled: false, or let fluid in with {}: inflow.",
                        side.key)};
    if (grains_adapter(s).moving_sides) return std::nullopt;
    return Objection{
        fmt::format("{} does not support moving sides.", s.text("grains.adapter")),
        fmt::format("Remove it, or use grains.adapter: {}.",
                    adapters_that([](const GrainsAdapter& a) { return a.moving_sides; }))};
}

std::optional<Objection> bad_inner_wall(const Settings& s, const InnerWall& wall) {
    if (!is_known(s, wall.motion)) return unknown_motion(s);
    if (!wall.moves_itself()) return std::nullopt;
    if (wall.space)
        return Objection{"A wall that follows a motion has no velocity and spin of its own.",
                         "Leave them empty, or motion."};
    return Objection{"A wall that follows a motion has no vx, vy and spin of its own.",
                     "Set them to 0, or leave motion empty."};
}

std::string walls_file(const Settings& s) {
    return std::filesystem::path(s.text("domain.walls_file")).filename().string();
}

void append(std::string& text, std::int64_t what, const Settings& s, const std::string& name,
            const Scales& scales) {
    const Kind& kind = kind_of(s, name);
    text += fmt::format("{}{} {} {}", text.empty() ? "" : ";", what, kind.name,
                        fmt::join(kind.numbers(s, name, scales), " "));
}

/// The motions of those sides that are inflows, or of those that are not.
std::string side_motions(const Settings& settings, const Scales& scales, bool inflows) {
    std::string text;
    for (std::size_t i = 0; i < box_sides.size(); ++i)
        if (const std::string key = motion_key(box_sides[i]);
            settings.has(key) && is_inflow(settings, box_sides[i]) == inflows)
            append(text, static_cast<std::int64_t>(i), settings, settings.text(key), scales);
    return text;
}

bool has_free_side(const Settings& s) {
    return std::any_of(box_sides.begin(), box_sides.end(),
                       [&](const BoxSide& side) { return is(s, side.key, "free"); });
}

/// The volumes that have entered and left through inflows by a time [D2], in space [D3].
struct Exchanged {
    double net = 0.0, either_way = 0.0;
};

Exchanged exchanged(const std::vector<Moved>& inflows, const std::vector<double>& size,
                    double time) {
    Exchanged sum;
    for (const Moved& inflow : inflows) {
        const BoxSide& side = box_sides.at(static_cast<std::size_t>(inflow.what));
        // Of the layer that has come in, positive inward; times the other lengths of the box it is
        // a volume.
        const double depth = side.inward * inflow.motion->at(time).displacement[side.axis];
        double volume = depth;
        for (std::size_t axis = 0; axis < size.size(); ++axis)
            if (static_cast<int>(axis) != side.axis) volume *= size[axis];
        sum.net += volume;
        sum.either_way += std::abs(volume);
    }
    return sum;
}

/// The end of the first window by which not as much fluid has entered a box without a free side as
/// has left it [t_c]. Of a longer run than a million windows the first million are tested.
std::optional<double> first_imbalance(const Settings& s) {
    Settings in_diameters;
    Scales unit;
    // Volumes in D and t_c: whether they balance does not depend on units.
    unit.diameter = unit.velocity = unit.time = 1.0;
    in_diameters.set("run.dimension", static_cast<std::int64_t>(dimension(s)));
    in_diameters.set("run.inflow_motions", side_motions(s, unit, true));
    const auto inflows = motions_of(in_diameters, "run.inflow_motions");
    const auto size = real_list("domain.size", s.text("domain.size"));
    const double step = s.real("time.step");
    const long long windows = std::min(std::llround(s.real("time.end") / step), 1'000'000LL);
    for (long long n = 1; n <= windows; ++n) {
        const double time = step * static_cast<double>(n);
        const Exchanged volume = exchanged(inflows, size, time);
        // An incompressible fluid has no other place to go: the net flux of every window must be
        // zero.
        if (std::abs(volume.net) > 1e-9 * volume.either_way) return time;
    }
    return std::nullopt;
}

/// What enters must leave.
CaseProblems check_balance(const Settings& s, const CaseEntries& entries) {
    const auto first = std::find_if(box_sides.begin(), box_sides.end(),
                                    [&](const BoxSide& side) { return is_inflow(s, side); });
    const bool known = s.has("domain.size") && s.has("time.step") && s.has("time.end");
    if (first == box_sides.end() || has_free_side(s) || !known) return {};
    const auto time = first_imbalance(s);
    if (!time) return {};
    const Objection objection{
        fmt::format("The box has no free side, and by {:.3g} t_c not as much fluid has left "
                    "through its inflows as has entered.",
                    *time),
        "Make a side free, or let the same flux leave through an opposite inflow."};
    return {problem_with(first->key, objection, s, entries)};
}

}  // namespace

std::vector<std::string> motion_names(const Settings& s) {
    const std::size_t start = std::string(prefix).size();
    std::vector<std::string> names;
    for (const auto& [key, value] : s.entries()) {
        if (key.rfind(prefix, 0) != 0) continue;
        const std::string name = key.substr(start, key.find('.', start) - start);
        // Settings are sorted by key: those of one motion follow each other.
        if (names.empty() || names.back() != name) names.push_back(name);
    }
    return names;
}

CaseProblems check_motions(const Settings& settings, const std::vector<InnerWall>& walls,
                           const CaseEntries& entries) {
    CaseProblems problems;
    for (const std::string& name : motion_names(settings))
        append(problems, check_motion(settings, name, entries));
    for (const BoxSide& side : box_sides)
        if (const std::string key = motion_key(side); settings.has(key))
            if (const auto objection = bad_side(settings, side))
                problems.push_back(problem_with(key, *objection, settings, entries));
    for (const InnerWall& wall : walls) {
        if (wall.motion.empty()) continue;
        if (const auto objection = bad_inner_wall(settings, wall))
            problems.push_back({.source = walls_file(settings),
                                .line = 0,
                                .key = {},
                                .value = {},
                                .fault = fmt::format("wall {}: motion = {}", wall.id, wall.motion),
                                .allowed = objection->allowed,
                                .remedy = objection->remedy});
    }
    if (!problems.empty()) return problems;  // what follows needs motions without faults
    for (const InnerWall& wall : walls)
        if (!wall.motion.empty())
            append(problems, check_period(wall, largest_turn(settings, wall.motion),
                                          packing_box(settings), walls_file(settings)));
    append(problems, check_balance(settings, entries));
    return problems;
}

std::vector<std::string> unfollowed_motions(const Settings& settings,
                                            const std::vector<InnerWall>& walls,
                                            const Packing& grains) {
    std::set<std::string> followed;
    for (const BoxSide& side : box_sides)
        if (const std::string key = motion_key(side); settings.has(key))
            followed.insert(settings.text(key));
    for (const InnerWall& wall : walls) followed.insert(wall.motion);
    for (const PlacedGrain& grain : grains) followed.insert(grain.motion);
    std::vector<std::string> notes;
    for (const std::string& name : motion_names(settings))
        if (!followed.contains(name))
            notes.push_back(fmt::format("no side, wall or grain follows domain.motions.{}", name));
    return notes;
}

std::string inflows_setting(const Settings& settings, const Scales& scales) {
    return side_motions(settings, scales, true);
}

std::string grain_motions_setting(const Settings& settings, const Packing& grains,
                                  const Scales& scales) {
    std::string text;
    for (const PlacedGrain& grain : grains)
        if (!grain.motion.empty()) append(text, grain.id, settings, grain.motion, scales);
    return text;
}

std::string motions_setting(const Settings& settings, const std::vector<InnerWall>& walls,
                            const Scales& scales) {
    std::string text = side_motions(settings, scales, false);
    const std::int32_t first = first_plate(static_cast<int>(dimension(settings)));
    for (std::size_t i = 0; i < walls.size(); ++i)
        if (!walls[i].motion.empty())
            append(text, first + static_cast<std::int32_t>(i), settings, walls[i].motion, scales);
    return text;
}

}  // namespace turbidite
