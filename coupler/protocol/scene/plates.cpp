// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/scene/plates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "coupler/protocol/number_text.hpp"

namespace turbidite {
namespace {

constexpr std::size_t numbers_per_plate = 12;
using Numbers = std::array<double, numbers_per_plate>;

/// Exactly twelve numbers.
Numbers numbers_of(const std::string& text) {
    const auto refuse = [&](const std::string& fault) {
        throw std::invalid_argument("run.walls: \"" + text + "\" " + fault);
    };
    std::vector<double> read;
    try {
        std::istringstream words(text);
        read = remaining_numbers(words);
    } catch (const std::invalid_argument& fault) {
        refuse(fault.what());
    }
    if (read.size() != numbers_per_plate)
        refuse("has " + std::to_string(read.size()) + " numbers, not 12");
    Numbers numbers;
    std::copy(read.begin(), read.end(), numbers.begin());
    return numbers;
}

Plate plate_of(const Numbers& n, std::int32_t key) {
    Plate plate;
    plate.key = key;
    plate.id = std::llround(n[0]);
    plate.from = {n[1], n[2], 0.0};
    plate.to = {n[3], n[4], 0.0};
    plate.pivot = {n[8], n[9], 0.0};
    plate.friction = n[10];
    plate.thickness = n[11];
    plate.motion = constant_motion({{n[5], n[6], 0.0}, {0.0, 0.0, n[7]}});
    return plate;
}

}  // namespace

double length(const Plate& plate) {
    return std::hypot(plate.to[0] - plate.from[0], plate.to[1] - plate.from[1]);
}

PlacedPlate place(const Plate& plate, double time, double step) {
    const Shift shift = plate.motion->at(time);
    const Twist rate = plate.motion->rate(time, step);
    // At t = 0: ends and pivot are those of the case.
    const Vec3 middle = 0.5 * (plate.from + plate.to), along = plate.to - plate.from;
    // From the pivot to the middle at `time`.
    const Vec3 arm = rotation(shift.angle)(middle - plate.pivot);
    return {plate.pivot + shift.displacement + arm,
            std::atan2(along[1], along[0]) + shift.angle[2],
            // v + omega x arm: the rate of the motion is that of the pivot.
            {rate.at(arm), rate.spin}};
}

std::vector<Plate> plates_of(const Settings& settings) {
    std::vector<Plate> plates;
    if (!settings.has("run.walls")) return plates;
    std::istringstream list(settings.text("run.walls"));
    const std::int32_t first = first_plate(dimension_of(settings));
    std::int32_t key = first;
    for (std::string text; std::getline(list, text, ';');)
        plates.push_back(plate_of(numbers_of(text), key++));
    for (const Moved& moved : motions_of(settings, "run.wall_motions"))
        // Keys below `first` are sides of the box, whose motions others read.
        if (const auto at = moved.what - first;
            at >= 0 && at < static_cast<std::int64_t>(plates.size()))
            plates[at].motion = moved.motion;
    return plates;
}

}  // namespace turbidite
