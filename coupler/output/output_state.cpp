// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/output_state.hpp"

#include <fmt/format.h>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

// As in wire.cpp: one description per record, passed a Writer or a Reader.

template <class Code>
void visit_wall(Code& code, WallTimes& wall) {
    code(wall.step), code(wall.fluid), code(wall.grains), code(wall.coupling);
}

template <class Code>
void visit_since(Code& code, SinceRow& since) {
    code(since.windows), code(since.unconverged), visit_wall(code, since.wall);
    code(since.work.contacts), code(since.work.fluid), code(since.work.films);
}

template <class Code>
void visit_fluid(Code& code, FluidMaxima& fluid) {
    code(fluid.divergence), code(fluid.final_divergence), code(fluid.courant);
    code(fluid.balance), code(fluid.slip), code(fluid.unconverged_windows);
    code(fluid.remaining_divergence), code(fluid.unconverged_splitting_windows);
}

template <class Code>
void visit_joint(Code& code, JointMaxima& joint) {
    code(joint.rounds), code(joint.mismatch), code(joint.unconverged_windows);
}

template <class Code, class Value, class Visit>
void visit_maybe(Code& code, std::optional<Value>& value, Visit visit) {
    // One function for both directions: a Writer gets the flag as it is, a Reader sets it.
    bool given = value.has_value();
    code(given);
    if (given && !value) value.emplace();
    if (!given) value.reset();
    if (given) visit(code, *value);
}

template <class Code>
void visit_statistics(Code& code, RunStatistics& statistics) {
    RunMaxima& maxima = statistics.maxima;
    code(statistics.windows_done), code(maxima.penetration), code(maxima.grain_balance);
    code(maxima.motion_defect), code(maxima.unconverged_windows);
    visit_maybe(code, maxima.contact_violation, [](auto& c, auto& violation) { c(violation); });
    visit_maybe(code, maxima.fluid, [](auto& c, auto& fluid) { visit_fluid(c, fluid); });
    visit_maybe(code, maxima.joint, [](auto& c, auto& joint) { visit_joint(c, joint); });
}

template <class Code>
void visit_lengths(Code& code, OutputLengths& lengths) {
    code(lengths.history), code(lengths.probes), code(lengths.grains), code(lengths.contacts);
}

std::string text_of(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

Bytes bytes_of(const std::string& text) {
    return {text.begin(), text.end()};
}

}  // namespace

Bytes encode(const OutputState& state) {
    OutputState copy = state;  // a visit may not change what a Writer is given
    Bytes out;
    Writer code(out);
    code(text_of(encode(state.state)));
    visit_statistics(code, copy.statistics);
    const std::vector<double>& residuals = state.statistics.contact_residuals.values();
    code(static_cast<std::int64_t>(residuals.size()));
    for (const double residual : residuals) code(residual);
    visit_since(code, copy.since_row);
    visit_lengths(code, copy.lengths);
    visit_lengths(code, copy.lengths_at_end);
    return out;
}

template <>
OutputState decode(View bytes) {
    OutputState state;
    Reader code(bytes);
    std::string motion;
    code(motion);
    state.state = decode<Motion>(bytes_of(motion));
    visit_statistics(code, state.statistics);
    std::vector<double> residuals(code.length());
    for (double& residual : residuals) code(residual);
    state.statistics.contact_residuals.replace(std::move(residuals));
    visit_since(code, state.since_row);
    visit_lengths(code, state.lengths);
    visit_lengths(code, state.lengths_at_end);
    code.finish();
    return state;
}

void require_length(const std::filesystem::path& file, std::int64_t length) {
    std::error_code error;
    const std::uintmax_t present = std::filesystem::file_size(file, error);
    // A file may have become longer since the checkpoint, never shorter.
    if (error || present < static_cast<std::uintmax_t>(length))
        throw Failure(
            ExitCode::bad_input,
            fmt::format("{} had {} bytes at the checkpoint and now {}: it was changed since. Put "
                        "the original back, or start a new run with --from",
                        file.string(), length,
                        error ? "is missing" : fmt::format("has {}", present)));
}

void cut_to(const std::filesystem::path& file, std::int64_t length) {
    require_length(file, length);
    std::error_code error;
    std::filesystem::resize_file(file, static_cast<std::uintmax_t>(length), error);
    if (error)
        throw Failure(ExitCode::participant_failed,
                      fmt::format("cannot write {}: {}", file.string(), error.message()));
}

}  // namespace turbidite
