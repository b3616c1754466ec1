// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The programs and modules of the build, the libraries they load, and that all load the same MPI.
#pragma once

#include "launcher/doctor/diagnosis.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {

/// One diagnosis per file of the build, then one about libmpi.
Diagnoses built_programs(const Programs& programs);

}  // namespace turbidite
