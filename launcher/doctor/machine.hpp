// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the machine leaves to a run: free disk and memory, and whether mpirun may start programs.
#pragma once

#include "launcher/doctor/diagnosis.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {

Diagnoses state_of_machine(const LaunchSite& site);

}  // namespace turbidite
