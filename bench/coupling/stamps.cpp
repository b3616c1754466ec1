// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/coupling/stamps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {
namespace {

/// Moments of the frames of one kind, by window.
struct Passage {
    double first_begin, last_end;
    bool sent;
};

std::map<std::int64_t, Passage> passages(const std::vector<Stamp>& stamps, Kind kind) {
    std::map<std::int64_t, Passage> found;
    for (const Stamp& stamp : stamps) {
        if (stamp.kind != kind) continue;
        const Passage own{stamp.begin, stamp.end, stamp.sent};
        Passage& all = found.try_emplace(stamp.window, own).first->second;
        all.first_begin = std::min(all.first_begin, own.first_begin);
        all.last_end = std::max(all.last_end, own.last_end);
    }
    return found;
}

}  // namespace

void write_stamps(const std::vector<Stamp>& stamps, const std::filesystem::path& file) {
    std::ofstream out(file);
    for (const Stamp& s : stamps)
        out << fmt::format("{} {} {} {:.9f} {:.9f} {}\n", static_cast<std::int32_t>(s.kind),
                           s.window, s.sent ? 1 : 0, s.begin, s.end, s.bytes);
    if (!out.flush()) throw Failure(ExitCode::participant_failed, "cannot write " + file.string());
}

std::vector<Stamp> read_stamps(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<Stamp> stamps;
    std::int32_t kind = 0, sent = 0;
    for (Stamp s; in >> kind >> s.window >> sent >> s.begin >> s.end >> s.bytes;) {
        s.kind = static_cast<Kind>(kind);
        s.sent = sent != 0;
        stamps.push_back(s);
    }
    if (stamps.empty() || !in.eof())
        throw Failure(ExitCode::participant_failed, "no stamps of messages in " + file.string());
    return stamps;
}

std::vector<double> delays(const std::vector<Stamp>& from, Kind in, const std::vector<Stamp>& to,
                           Kind out, std::int64_t first) {
    const auto starts = passages(from, in), ends = passages(to, out);
    std::vector<double> result;
    for (const auto& [window, start] : starts) {
        const auto end = ends.find(window);
        if (window < first || end == ends.end()) continue;
        result.push_back(end->second.last_end - (start.sent ? start.first_begin : start.last_end));
    }
    return result;
}

std::int64_t bytes_of(const std::vector<Stamp>& stamps, Kind kind, std::int64_t window) {
    std::int64_t sum = 0;
    for (const Stamp& stamp : stamps)
        if (stamp.kind == kind && stamp.window == window) sum += stamp.bytes;
    return sum;
}

}  // namespace turbidite::bench
