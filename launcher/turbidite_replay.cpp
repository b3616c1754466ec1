// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-replay RUN ROLE RECORDING: in the place of the coupler, plays a recording to one
// participant, `grains` or `fluid`; started by `turbidite replay`.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>

#include "coupler/output/run_record.hpp"
#include "coupler/replay/replay.hpp"
#include "coupler/transport/intercomm_channel.hpp"
#include "coupler/transport/joining.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/files/run_folder.hpp"

namespace {

using namespace turbidite;

constexpr std::int64_t lines_of_progress = 10;

/// Ten lines over the whole.
void show_progress(std::int64_t window, std::int64_t windows) {
    const std::int64_t every = std::max<std::int64_t>(1, windows / lines_of_progress);
    if (window > 0 && window % every == 0) {
        fmt::print("window {} of {}\n", window, windows);
        std::fflush(stdout);
    }
}

std::string summary(const ReplayReport& report, const std::string& role) {
    std::string text = fmt::format("{} windows, {} messages of the {} compared: ", report.windows,
                                   report.messages, role);
    text += report.differences == 0 ? "identical\n"
                                    : fmt::format("{} differ, by up to {:.3g} of the largest\n",
                                                  report.differences, report.largest);
    for (const std::string& sentence : report.first) text += "  " + sentence + "\n";
    if (!report.complete) text += "The recording ends there: its run did not end by itself.\n";
    return text;
}

void record_end(const RunFolder& folder, ExitCode code, const std::string& reason) {
    RunStatus status;
    status.code = code;
    status.reason = reason;
    write_run_record(folder.record(), status, {});
}

MPI_Comm join(const RunFolder& folder, const Settings& settings, const std::string& role,
              std::optional<MpiEnvironment>& mpi) {
    const Role participant = role == role_name(Role::fluid) ? Role::fluid : Role::grains;
    Joining joining(folder.root, settings, {participant},
                    [&](ExitCode code, const std::string& text) {
                        std::fprintf(stderr, "turbidite-replay: %s\n", text.c_str());
                        record_end(folder, code, text);
                    });
    return joining.meet(joining.join_world(mpi)).intercomm;
}

ExitCode play(const RunFolder& folder, const std::string& role, const std::string& file,
              std::optional<MpiEnvironment>& mpi) {
    const ResolvedCase resolved = load_run_folder(folder.root);
    Recording recording(file);
    IntercommChannel channel(join(folder, resolved.settings, role, mpi));
    ReplayOrder order;
    order.limit = resolved.settings.real("limits.stall_hard");
    const std::int64_t windows = resolved.settings.integer("run.windows");
    order.progress = [&](std::int64_t window) { show_progress(window, windows); };
    const ReplayReport report = replay(recording, channel, order);
    fmt::print("{}", summary(report, role));
    std::fflush(stdout);
    return report.differences == 0 ? ExitCode::done : ExitCode::tests_failed;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: turbidite-replay RUN ROLE RECORDING\n");
        return static_cast<int>(turbidite::ExitCode::bad_input);
    }
    const RunFolder folder{argv[1]};
    std::optional<MpiEnvironment> mpi;
    try {
        const ExitCode code = play(folder, argv[2], argv[3], mpi);
        record_end(folder, ExitCode::done, "");  // that the participants may leave
        // The participant waits in MPI_Finalize; a difference must not abort it.
        if (code != ExitCode::done)
            std::ofstream(folder.root / "differences") << "see the output of turbidite replay\n";
        return 0;
    } catch (const std::exception& error) {
        const ExitCode code = code_of(error);
        std::fprintf(stderr, "turbidite-replay: %s\n", error.what());
        std::fflush(nullptr);
        record_end(folder, code, error.what());
        if (mpi) PMPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
        return static_cast<int>(code);
    }
}
