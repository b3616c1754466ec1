// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Runs of an installation whose turbidite-fluid is faulty_fluid.
#pragma once

#include "tests/failure/failing_run.hpp"

namespace turbidite {

class FailingFluid : public FailingRun {
 protected:
    // `turbidite` looks for its programs in its own folder, after following links.
    void SetUp() override {
        FailingRun::SetUp();
        const std::filesystem::path program = TURBIDITE_PROGRAM;
        const std::filesystem::path bin = scratch.path() / "bin";
        std::filesystem::create_directory(bin);
        std::filesystem::copy_file(program, bin / "turbidite");
        for (const char* name : {"turbidite-coupler", "turbidite-grains", "turbidite-member"})
            std::filesystem::create_symlink(program.parent_path() / name, bin / name);
        std::filesystem::create_symlink(FAULTY_FLUID, bin / "turbidite-fluid");
    }

    Answer run_with(const std::string& fault, const std::string& options = "") const {
        return shell("TURBIDITE_FAULT=" + fault + " " + run_line(options, "bin/turbidite"));
    }
};

}  // namespace turbidite
