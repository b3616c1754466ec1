// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Locations of the programs and scripts of the job: beside the running program in the build folder
// and in the source tree, or under the prefix where both were installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "launcher/case/forecast/mesh_cost.hpp"

namespace turbidite {

struct Programs {
    std::filesystem::path folder;   ///< BUILD/bin, absolute
    std::filesystem::path library;  ///< BUILD/lib
    std::filesystem::path source;   ///< top of the source tree, or what was installed of it
    bool installed = false;         ///< under a prefix, without sources, tests and benchmarks
    /// Program and arguments in the place of that of the case; empty: that one.
    std::vector<std::string> other_fluid = {};
    bool scripted_fluid = false;  ///< the other one computes no fluid

    std::filesystem::path build() const { return folder.parent_path(); }
    std::filesystem::path coupler() const { return folder / "turbidite-coupler"; }
    /// Starts every program of a job and notices when one ends too early.
    std::filesystem::path member() const { return folder / "turbidite-member"; }
    std::filesystem::path fluid(FluidProgram program) const {
        if (!other_fluid.empty()) return other_fluid.front();
        return folder / (program == FluidProgram::box ? "turbidite-fluid-box" : "turbidite-fluid");
    }
    /// A recording in the place of coupler and partner.
    std::filesystem::path replay() const { return folder / "turbidite-replay"; }
    /// A scripted fluid, for adapter-test.
    std::filesystem::path partner() const { return folder / "turbidite-partner"; }
    std::filesystem::path bench() const { return folder / "turbidite-bench"; }
    std::filesystem::path yade() const { return "/usr/bin/yade"; }
    /// The extension that YADE's Python imports, and the scripts beside it.
    std::filesystem::path yade_folder() const { return library / "yade"; }
    std::filesystem::path yade_extension() const { return yade_folder() / "turbidite_yade.so"; }
    /// The module turbidite_adapter, for grains programs in Python.
    std::filesystem::path python_module() const { return library / "python"; }
    std::filesystem::path python() const { return "/usr/bin/python3"; }
    std::filesystem::path report() const { return source / "launcher/report/report.py"; }
    std::filesystem::path film() const { return source / "launcher/report/film.py"; }
    std::filesystem::path view() const { return source / "launcher/report/view.py"; }
    /// The pages as a site, once it is built.
    std::filesystem::path site() const {
        return installed ? source.parent_path() / "doc/turbidite/html" : build() / "site";
    }
    std::filesystem::path site_script() const { return source / "launcher/site/site.py"; }
    std::filesystem::path study() const { return source / "launcher/report/study.py"; }
    std::filesystem::path gallery() const { return source / "launcher/report/gallery/main.py"; }
    /// The shipped cases, and what is expected of them.
    std::filesystem::path configs() const { return source / "configs"; }
    std::filesystem::path expected() const { return configs() / "expected.yaml"; }
    std::filesystem::path compare() const { return source / "launcher/report/compare.py"; }
};

/// Those of the running program.
Programs find_programs();

/// Throws Failure (bad input) in words if what is asked for was not installed: "tests",
/// "benchmarks".
void require_checkout(const Programs& programs, const std::string& what);

}  // namespace turbidite
