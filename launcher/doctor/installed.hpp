// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The software of others that a run and its report need, with its versions.
#pragma once

#include "launcher/doctor/diagnosis.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {

/// OpenFOAM, YADE, Open MPI, and the Python modules of report and adapters.
Diagnoses installed_software(const LaunchSite& site);

/// Compiler, CMake and Ninja: of interest only if something is not built.
Diagnoses build_tools();

}  // namespace turbidite
