// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A coupled job of some seconds: the first windows of configs/quickstart.yaml with a few grains,
// through OpenFOAM, YADE and the coupler, in a temporary folder.
#pragma once

#include "launcher/doctor/diagnosis.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {

/// Throws Failure (exit code 130) if a signal stopped it.
Diagnosis play_short_job(const LaunchSite& site);

}  // namespace turbidite
