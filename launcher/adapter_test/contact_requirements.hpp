// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What grains do that touch: with friction and spin, against grains that do not give way, and what
// they report of it. Judged by the states that the program sent, window by window.
#pragma once

#include "launcher/adapter_test/verdicts.hpp"

namespace turbidite {

/// A grain that slides on the floor slows down by mu g and is turned until it rolls: a disc with
/// two thirds of its velocity, a sphere with five sevenths.
Finding slides_into_rolling(const Candidate& candidate, const std::filesystem::path& folder);

/// Two grains that pass each other closely: the tangential impulse is mu times the normal one and
/// against the slip, momentum and angular momentum are conserved.
Finding collides_with_friction(const Candidate& candidate, const std::filesystem::path& folder);

/// A held grain stays where it is under one that falls on it, and a driven one keeps its velocity.
Finding respects_held_grains(const Candidate& candidate, const std::filesystem::path& folder);

/// The single contacts of a grain add up to its contact impulse.
Finding reports_contacts(const Candidate& candidate, const std::filesystem::path& folder);

/// Deepest overlap [m] of discs or spheres, with each other and with walls at all sides.
double overlap_of(const Motion& state, const Settings& settings);

/// The deepest overlap of a trial [D], from its positions; failed where the program reported less.
struct Overlap {
    double deepest = 0.0;
    Finding finding;
};
Overlap judge_overlap(const Trial& trial);

}  // namespace turbidite
