// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/timing/run_benchmark.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/timing/memory_triad.hpp"
#include "bench/timing/site.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {
namespace {

/// A figure, with its result once measured.
struct Entry {
    const Figure* figure = nullptr;
    std::string command;
    Measured measured = {};
    std::string reason = "not measured";  // why there is no value
};

bool wanted(const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

void refuse_unknown(const char* what, const std::vector<std::string>& names,
                    const std::vector<std::string>& known) {
    for (const std::string& name : names)
        if (!wanted(known, name))
            throw Failure(ExitCode::bad_input, fmt::format("there is no {} \"{}\"; there are {}",
                                                           what, name, fmt::join(known, ", ")));
}

std::vector<Entry> entries_of(const BenchOrder& order) {
    std::vector<std::string> benchmarks, figures;
    std::vector<Entry> entries;
    for (const Benchmark& benchmark : benchmark_list()) {
        benchmarks.push_back(benchmark.name);
        if (!wanted(order.benchmarks, benchmark.name)) continue;
        for (const Figure& figure : benchmark.figures) {
            figures.push_back(figure.name);
            if (!wanted(order.figures, figure.name)) continue;
            entries.push_back(
                {&figure, fmt::format("./turbidite bench {} --figure {}{}", benchmark.name,
                                      figure.name, order.quick ? " --quick" : "")});
        }
    }
    refuse_unknown("benchmark", order.benchmarks, benchmarks);
    refuse_unknown("figure", order.figures, figures);
    return entries;
}

void measure(Entry& entry, Site& site) {
    fmt::print(stderr, "{}: {}\n", entry.figure->name, entry.figure->what);
    try {
        entry.measured = entry.figure->measure(site);
        entry.reason.clear();
        const double value = entry.measured.value;
        if (!(std::isfinite(value) && value > 0.0))
            entry.reason = fmt::format("the result {} is not a valid measurement", value);
    } catch (const Failure& failure) {
        entry.reason = failure.what();
        if (failure.code() == ExitCode::interrupted) throw;
    } catch (const std::exception& error) {
        entry.reason = error.what();
    }
    for (const std::string& note : entry.measured.notes) fmt::print(stderr, "  {}\n", note);
    if (!entry.reason.empty()) fmt::print(stderr, "  not available: {}\n", entry.reason);
}

std::string verdict(const Entry& entry) {
    if (!entry.reason.empty()) return "not available";
    if (entry.figure->reach.kind == Reach::Kind::none) return "";
    return entry.figure->reach.met(entry.measured.value) ? "reached" : "out of reach";
}

std::string table(const std::vector<Entry>& entries) {
    std::string text = fmt::format("{:<22} {:>8}  {:>10}  {:>21}  {:<7}\n", "figure", "reach",
                                   "measured", "lowest - highest", "unit");
    for (const Entry& entry : entries) {
        const Measured& m = entry.measured;
        const bool there = entry.reason.empty();
        text +=
            fmt::format("{:<22} {:>8}  {:>10}  {:>21}  {:<7} {}\n", entry.figure->name,
                        entry.figure->reach.text(), there ? fmt::format("{:.4g}", m.value) : "-",
                        there ? fmt::format("{:.4g} - {:.4g}", m.lowest, m.highest) : "-",
                        entry.figure->unit, verdict(entry));
    }
    return text;
}

nlohmann::ordered_json json_of(const Entry& entry) {
    nlohmann::ordered_json json = {
        {"value", nullptr}, {"unit", entry.figure->unit}, {"command", entry.command}};
    if (!entry.reason.empty()) {
        json["reason"] = entry.reason;
        return json;
    }
    json["value"] = entry.measured.value;
    json["lowest"] = entry.measured.lowest;
    json["highest"] = entry.measured.highest;
    if (entry.figure->reach.kind != Reach::Kind::none) {
        json["reach"] = entry.figure->reach.text();
        json["reached"] = entry.figure->reach.met(entry.measured.value);
    }
    json["notes"] = entry.measured.notes;
    return json;
}

Failure cannot_be_written(const std::filesystem::path& file) {
    return Failure(
        ExitCode::bad_input,
        fmt::format("--json = {} cannot be written: choose another file", file.string()));
}

void require_writable(const std::filesystem::path& file) {
    if (!std::ofstream(file, std::ios::app)) throw cannot_be_written(file);
}

void write_json(const std::vector<Entry>& entries, const std::filesystem::path& file) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const Entry& entry : entries) json[entry.figure->name] = json_of(entry);
    std::ofstream stream(file);
    stream << json.dump(2) << "\n";
    if (!stream.flush()) throw cannot_be_written(file);
}

}  // namespace

bool run_benchmarks(const BenchOrder& order) {
    std::vector<Entry> entries = entries_of(order);
    if (!order.json.empty()) require_writable(order.json);  // not after an hour
    Site site(order.quick);
    double load = 0.0;  // of the machine before the benchmark
    ::getloadavg(&load, 1);
    fmt::print("machine: {} processors, load {:.1f}, memory triad {:.1f} GB/s on one core\n",
               ::sysconf(_SC_NPROCESSORS_ONLN), load, 1e-9 * memory_triad());
    std::fflush(stdout);
    const auto tell = [&] {
        fmt::print("{}", table(entries));
        if (!order.json.empty()) write_json(entries, order.json);
    };
    try {
        for (Entry& entry : entries) measure(entry, site);
    } catch (const Failure&) {  // interrupted
        tell();
        throw;
    }
    tell();
    return std::all_of(entries.begin(), entries.end(),
                       [](const Entry& entry) { return entry.reason.empty(); });
}

std::string benchmark_overview() {
    std::string text;
    for (const Benchmark& benchmark : benchmark_list()) {
        text += fmt::format("{}: {}\n", benchmark.name, benchmark.help);
        for (const Figure& figure : benchmark.figures)
            text += fmt::format("  {:<22} {}\n", figure.name, figure.what);
    }
    return text;
}

}  // namespace turbidite::bench
