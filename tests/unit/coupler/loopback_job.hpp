// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A whole job without MPI: the hub and scripted participants in threads, connected by loopback
// channels; and its output.
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include "coupler/participant/scripted.hpp"
#include "coupler/participant/session.hpp"
#include "coupler/transport/loopback_channel.hpp"
#include "coupler/transport/recording.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {

inline constexpr double drag = 0.3;

struct Job {
    Settings settings = test_settings();
    std::vector<GrainState> population = test_population();
    int grains_ranks = 1, fluid_ranks = 1;
    Fault grains_fault, fluid_fault;
    LoopbackChannel::Hook to_grains;
    std::string adapter = "scripted";
    std::string hash = "0123456789abcdef";
    std::optional<double> floor;  // height of the floor under the grains
    double inertia_error = 0.0;   // relative error of the fluid's effective inertia
    LoopbackChannel::Hook to_fluid;
    LoopbackChannel::Hook from_fluid, from_grains;
    std::optional<SchemeEntry> scheme;  // instead of run.scheme
    std::filesystem::path recordings;   // folder for grains.frames and fluid.frames
    std::function<std::unique_ptr<GrainsAdapter>()> make_grains;  // instead of ScriptedGrains
    std::string resume;                                           // a checkpoint to go on from
    bool grains_save = true;                                      // the grains can save their state

    RunStatus status;
    std::vector<Outcome> outcomes;
    std::string told;  // of recordings

    void run(const TestFolder& folder) {
        const bool wet = settings.flag("fluid.enabled");
        settings.set("grains.ranks", std::int64_t{grains_ranks});
        settings.set("fluid.ranks", std::int64_t{fluid_ranks});
        auto [grains, grains_ends] = LoopbackChannel::connect(grains_ranks);
        auto [fluid, fluid_ends] = LoopbackChannel::connect(fluid_ranks);
        grains->set_hook(to_grains);
        fluid->set_hook(to_fluid);
        for (const auto& end : fluid_ends) end->set_hook(from_fluid);
        for (const auto& end : grains_ends) end->set_hook(from_grains);
        outcomes.resize(grains_ranks + (wet ? fluid_ranks : 0));

        std::vector<std::thread> threads;
        for (int rank = 0; rank < grains_ranks; ++rank)
            threads.emplace_back([&, rank, end = grains_ends[rank].get()] {
                const std::unique_ptr<GrainsAdapter> grains_program = grains_adapter();
                outcomes[rank] = live(
                    *make_session(*grains_program, *end, identity(folder, rank, grains_ranks)));
            });
        for (int rank = 0; wet && rank < fluid_ranks; ++rank)
            threads.emplace_back([&, rank, end = fluid_ends[rank].get()] {
                ScriptedFluid adapter_object(drag, rank, fluid_ranks, fluid_fault);
                adapter_object.misjudge_inertia(inertia_error);
                outcomes[grains_ranks + rank] =
                    live(*make_session(adapter_object, *end, identity(folder, rank, fluid_ranks)));
            });
        {
            Channel *to_grains_program = grains.get(), *to_fluid_program = fluid.get();
            std::optional<RecordingChannel> grains_recorded, fluid_recorded;
            if (!recordings.empty()) {
                const auto tell = [this](const std::string& text) { told += text; };
                to_grains_program =
                    &grains_recorded.emplace(*grains, recordings / "grains.frames", tell);
                to_fluid_program =
                    &fluid_recorded.emplace(*fluid, recordings / "fluid.frames", tell);
            }
            Hub hub({settings, {{"disc", {}}}, population, resumption(folder)}, folder.files(),
                    *to_grains_program, wet ? to_fluid_program : nullptr,
                    scheme ? *scheme : find_scheme(settings.text("run.scheme")));
            status = hub.run();
        }
        for (std::thread& thread : threads) thread.join();
    }

 private:
    std::unique_ptr<GrainsAdapter> grains_adapter() const {
        if (make_grains) return make_grains();
        auto grains = std::make_unique<ScriptedGrains>(adapter, grains_fault);
        if (floor) grains->lay_floor(*floor);
        grains->can_save(grains_save);
        return grains;
    }
    Identity identity(const TestFolder& folder, int rank, int ranks) const {
        return {rank, ranks, "a.log", hash, folder.path().string()};
    }
    std::optional<Resumption> resumption(const TestFolder& folder) const {
        if (resume.empty()) return std::nullopt;
        const StoredFile own = CheckpointSets(folder.path()).manifest(resume).coupler;
        const auto place = folder.path() / CheckpointSets::folder(resume);
        return Resumption{resume, decode<CouplerState>(load(place, own))};
    }
    static Outcome live(Session& session) {
        for (bool going = session.start(); going; going = session.step()) {
        }
        return session.outcome();
    }
};

using Rows = std::vector<std::vector<std::string>>;

inline Rows read_csv(const std::filesystem::path& file) {
    Rows rows;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        rows.emplace_back();
        std::stringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
}

inline std::size_t column(const std::vector<std::string>& header, const std::string& name) {
    return std::find(header.begin(), header.end(), name) - header.begin();
}

/// Rows are counted from the header.
inline double cell(const Rows& rows, std::size_t row, const std::string& name) {
    const std::string& text = rows.at(row).at(column(rows[0], name));
    return text.empty() ? NAN : std::stod(text);
}

}  // namespace turbidite
