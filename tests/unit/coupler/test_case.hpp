// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A small case for the coupler's tests: three discs in a 10 x 10 box, rho_s/rho_f = 1.5, g = 1.
#pragma once

#include <unistd.h>

#include <filesystem>

#include "coupler/hub/hub.hpp"
#include "tests/run_settings.hpp"

namespace turbidite {

inline Settings test_settings(const std::string& scheme = "split", bool fluid = true) {
    Settings s = run_settings();
    s.set("grains.adapter", std::string("scripted"));
    s.set("grains.ranks", std::int64_t{1});
    s.set("fluid.ranks", std::int64_t{1});
    s.set("fluid.enabled", fluid);
    s.set("fluid.cells_per_diameter", 8.0);
    s.set("coupling.scheme", scheme);
    s.set("run.scheme", fluid ? scheme : std::string("dry"));
    s.set("run.slip_tolerance", 1e-4);
    s.set("fluid.multiplier_tolerance", 1e-4);
    s.set("fluid.multiplier_iterations", std::int64_t{200});
    s.set("fluid.splitting", std::string("marchuk-yanenko"));
    s.set("coupling.tolerance", 1e-9);
    s.set("coupling.iterations", std::int64_t{10});
    s.set("limits.stall_soft", 5.0);
    s.set("limits.stall_hard", 20.0);
    s.set("limits.penetration", 0.2);
    s.set("limits.grain_balance_soft", 1e-8);
    s.set("limits.grain_balance_hard", 1e-4);
    s.set("limits.fluid_balance_soft", 1e-6);
    s.set("limits.fluid_balance_hard", 1e-2);
    s.set("run.hash", std::string("0123456789abcdef"));
    return s;
}

inline std::vector<GrainState> test_population() {
    std::vector<GrainState> grains(3);
    for (int i = 0; i < 3; ++i) {
        grains[i].id = 100 + i;
        grains[i].radius = 0.5;
        grains[i].density = 1.5;
        grains[i].position = {2.0 + 2.5 * i, 5.0, 0.0};
    }
    return grains;
}

/// A separate folder for each test, removed afterwards.
class TestFolder {
 public:
    explicit TestFolder(const std::string& name)
        : path_(std::filesystem::temp_directory_path() /
                ("turbidite-" + name + "-" + std::to_string(getpid()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TestFolder() { std::filesystem::remove_all(path_); }
    const std::filesystem::path& path() const { return path_; }
    HubFiles files() const {
        return {path_ / "history.csv", path_ / "grains", path_ / "coupler.log", path_ / "run.json",
                path_};
    }

 private:
    std::filesystem::path path_;
};

}  // namespace turbidite
