// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/progress.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace turbidite {
namespace {

constexpr std::chrono::milliseconds refresh{500};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double mean_fall(const Motion& state) {
    double sum = 0.0;
    for (const GrainState& grain : state.grains) sum -= grain.velocity[1];
    return state.grains.empty() ? 0.0 : sum / static_cast<double>(state.grains.size());
}

constexpr auto not_converged = " NOT CONVERGED";

std::string contact_text(const ContactReport& report) {
    return fmt::format("  contacts {} ({} {}{}{})", report.contacts, report.iterations,
                       report.residual ? "sweeps" : "sub-steps",
                       report.residual ? fmt::format(", {:.0e}", *report.residual) : "",
                       report.converged ? "" : not_converged);
}

std::string fluid_text(const FluidReport& report, const RunValues& run) {
    std::string text =
        fmt::format("  multipliers {} its, {:.0e}{}  Courant {:.2f}", report.multiplier_iterations,
                    report.multiplier_residual / run.velocity,
                    report.multipliers_converged ? "" : not_converged, report.courant);
    if (const auto& splitting = report.splitting)
        text += fmt::format(
            "  pressure {} its, div {:.0e} u_c/D, viscosity {} its, {:.0e} u_c2/D{}",
            splitting->pressure_iterations, splitting->divergence * run.diameter / run.velocity,
            splitting->viscous_iterations,
            splitting->viscous_residual * run.diameter / (run.velocity * run.velocity),
            splitting->converged ? "" : not_converged);
    if (report.final_divergence > 0.0)  // computed in windows with output
        text += fmt::format("  divergence after step 5 {:.0e} u_c/D",
                            report.final_divergence * run.diameter / run.velocity);
    return text;
}

std::string joint_text(const JointReport& report, const RunValues& run) {
    std::string text = fmt::format("  rounds {}", report.rounds);
    if (!report.converged)
        text += fmt::format("{}: {:.0e} u_c", not_converged, report.mismatch / run.velocity);
    return text;
}

std::string solves(const Row& row, const RunValues& run) {
    std::string text;
    if (row.contact) text += contact_text(*row.contact);
    if (row.fluid) text += fluid_text(*row.fluid, run);
    if (row.joint) text += joint_text(*row.joint, run);
    return text;
}

double fall_of(const Row& row, const RunValues& run) {
    return mean_fall(*row.state) / run.velocity;
}

double overlap_of(const Row& row, const RunValues& run) {
    return row.state->report.max_penetration / run.diameter;
}

bool all_converged(const Row& row) {
    return (!row.contact || row.contact->converged) &&
           (!row.fluid || row.fluid->multipliers_converged) && (!row.joint || row.joint->converged);
}

std::string log_line(const Row& row, const RunValues& run, double per_window) {
    return fmt::format(
        "window {}/{}  t/t_c {:.3f}  fall {:.4f} u_c  overlap {:.0e} D{}  {:.3f} s/window",
        row.step, run.windows, row.time / run.time, fall_of(row, run), overlap_of(row, run),
        solves(row, run), per_window);
}

/// So many decimals that times of rows differ, and the end is not passed: at least one, and at most
/// what a line of sixty columns has room for.
int decimals(const RunValues& run) {
    const double interval = static_cast<double>(run.output_every) * run.step / run.time;
    const double end = static_cast<double>(run.windows) * run.step / run.time;
    const auto whole = [](double value) { return std::abs(value - std::round(value)) < 1e-6; };
    const int most = end < 10.0 ? 4 : end < 100.0 ? 2 : 1;
    int digits = 1;
    for (double unit = 10.0; digits < most && !(whole(interval * unit) && whole(end * unit));
         unit *= 10.0)
        ++digits;
    return digits;
}

}  // namespace

std::string progress_line(const Row& row, const RunValues& run, double per_window) {
    const double end = static_cast<double>(run.windows) * run.step;
    const double left = per_window * static_cast<double>(run.windows - row.step);
    return fmt::format(
        "{:.{}f}/{:.4g} t_c  {}  overlap {:.0e} D  {} left", row.time / run.time, decimals(run),
        end / run.time,
        all_converged(row) ? fmt::format("fall {:.3f} u_c", fall_of(row, run)) : "NOT CONVERGED",
        overlap_of(row, run), clock_text(left));
}

std::string clock_text(double seconds) {
    const long s = static_cast<long>(seconds + 0.5);
    if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
    return fmt::format("{}:{:02}", s / 60, s % 60);
}

Progress::Progress(const std::filesystem::path& log, bool terminal, const RunValues& run)
    : terminal_(terminal), run_(run) {
    std::filesystem::create_directories(log.parent_path());
    log_.open(log, std::ios::app);
}

void Progress::clear_line() {
    if (line_open_) std::fputs("\r\033[K", stdout);
    line_open_ = false;
}

void Progress::say(const std::string& text) {
    clear_line();
    std::fputs((text + "\n").c_str(), stdout);
    std::fflush(stdout);
    log(text);
}

void Progress::log(const std::string& text) {
    log_ << text << std::endl;
}

void Progress::show(const Row& row, bool due) {
    // On a terminal the line is rewritten in between; a log gets the windows with output only.
    if (!due && !(terminal_ && Clock::now() - last_shown_ > refresh)) return;
    last_shown_ = Clock::now();
    const double per_window =
        // Of this part of the run: what an earlier one took is not known to be as fast.
        seconds_since(start_) / static_cast<double>(row.step - windows_before_);
    if (due) log_ << log_line(row, run_, per_window) << std::endl;
    const std::string line = progress_line(row, run_, per_window);
    if (terminal_) {
        std::fputs(("\r\033[K" + line).c_str(), stdout);
        line_open_ = row.step < run_.windows;
        if (!line_open_) std::fputs("\n", stdout);
    } else {
        std::fputs((line + "\n").c_str(), stdout);
    }
    std::fflush(stdout);
}

}  // namespace turbidite
