// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/timing/step_clock.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {

double processor_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double median(std::vector<double> values) {
    if (values.empty()) throw std::invalid_argument("the median of an empty list is undefined");
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double resident_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kib = 0.0; word == "VmRSS:" && status >> kib) return 1024.0 * kib;
    throw Failure(ExitCode::participant_failed, "/proc/self/status has no line VmRSS");
}

void StepClock::start() {
    processor_so_far_ = wall_so_far_ = 0.0;
    resume();
}

void StepClock::resume() {
    runs_ = true;
    wall_start_ = wall_seconds();
    processor_start_ = processor_seconds();
}

void StepClock::pause() {
    processor_so_far_ += processor_seconds() - processor_start_;
    wall_so_far_ += wall_seconds() - wall_start_;
    runs_ = false;
}

void StepClock::stop() {
    if (runs_) pause();
    processor_.push_back(processor_so_far_);
    wall_.push_back(wall_so_far_);
}

double StepClock::processor_sum() const {
    return std::accumulate(processor_.begin(), processor_.end(), 0.0);
}

double StepClock::wall_sum() const {
    return std::accumulate(wall_.begin(), wall_.end(), 0.0);
}

void write_sample(const Sample& sample, const std::filesystem::path& file) {
    const nlohmann::json json = {{"processor", sample.processor}, {"wall", sample.wall},
                                 {"resident", sample.resident},   {"arrays", sample.arrays},
                                 {"parts", sample.parts},         {"counts", sample.counts}};
    std::ofstream stream(file);
    stream << json << "\n";
    if (!stream.flush())
        throw Failure(ExitCode::participant_failed, "cannot write " + file.string());
}

Sample read_sample(const std::filesystem::path& file) try {
    std::ifstream stream(file);
    const nlohmann::json json = nlohmann::json::parse(stream);
    return {json.at("processor"), json.at("wall"),  json.at("resident"),
            json.at("arrays"),    json.at("parts"), json.at("counts")};
} catch (const nlohmann::json::exception& error) {
    throw Failure(
        ExitCode::participant_failed,
        "the result " + file.string() + " of a contender cannot be read: " + error.what());
}

}  // namespace turbidite::bench
