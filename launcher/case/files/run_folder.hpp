// SPDX-License-Identifier: LGPL-2.1-or-later
//
// All paths of a run folder.
#pragma once

#include <filesystem>
#include <string>

#include "coupler/protocol/files/run_files.hpp"

namespace turbidite {

struct RunFolder {
    std::filesystem::path root;

    std::filesystem::path resolved_case() const { return root / "case.yaml"; }
    std::filesystem::path record() const { return root / "run.json"; }
    std::filesystem::path history() const { return root / "history.csv"; }
    std::filesystem::path grains() const { return root / "grains"; }
    std::filesystem::path initial_grains() const { return grains() / "initial.csv"; }
    std::filesystem::path walls() const { return grains() / "walls.csv"; }
    std::filesystem::path grains_series() const { return grains() / "grains.pvd"; }
    std::filesystem::path fluid() const { return root / "fluid"; }
    std::filesystem::path logs() const { return root / "logs"; }
    std::filesystem::path log(const std::string& role) const { return logs() / (role + ".log"); }
    /// Messages of "grains" or "fluid", if coupling.recording says so.
    std::filesystem::path recording(const std::string& role) const {
        return recordings() / (role + ".frames");
    }
    /// With the checkpoint from which the recorded part of the run began, if it was resumed.
    std::filesystem::path recordings() const { return root / "recording"; }
    std::filesystem::path report() const { return root / "report.html"; }
    std::filesystem::path pictures() const { return root / "pictures"; }
    std::filesystem::path film() const { return root / "film.webp"; }
    std::filesystem::path view() const { return root / "view.py"; }

    std::filesystem::path checkpoints() const { return root / "checkpoints"; }

    /// Requests of a user (coupler/hub/requests.hpp).
    std::filesystem::path stop() const { return root / stop_file; }
};

}  // namespace turbidite
