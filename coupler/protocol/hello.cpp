// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/hello.hpp"

#include <algorithm>

namespace turbidite {
namespace {

class Report {
 public:
    explicit Report(const Hello& hello)
        : who_(std::string(role_name(hello.role)) + " rank " + std::to_string(hello.rank)) {}

    void demand(bool holds, const std::string& what, const std::string& theirs,
                const std::string& ours) {
        if (!holds)
            sentences_.push_back(who_ + ": " + what + " is " + (theirs.empty() ? "none" : theirs) +
                                 ", the case needs " + ours);
    }
    std::vector<std::string> sentences_;

 private:
    std::string who_;
};

std::string version(std::int32_t minor, std::int32_t major = protocol_major) {
    return std::to_string(major) + "." + std::to_string(minor);
}

bool contains(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

std::string joined(const std::vector<std::string>& list) {
    std::string all;
    for (const std::string& name : list) all += (all.empty() ? "" : ", ") + name;
    return all;
}

}  // namespace

const char* role_name(Role role) {
    switch (role) {
        case Role::coupler:
            return "coupler";
        case Role::fluid:
            return "fluid";
        case Role::grains:
            return "grains";
    }
    return "unknown role";
}

std::vector<std::string> mismatches(const Hello& hello, const Expectation& expected) {
    Report report(hello);
    report.demand(hello.protocol_major == protocol_major, "protocol version",
                  version(hello.protocol_minor, hello.protocol_major),
                  std::to_string(protocol_major) + ".x");
    // Minor versions of another major one mean nothing: one sentence is enough.
    report.demand(hello.protocol_major != protocol_major || hello.protocol_minor >= oldest_minor,
                  "protocol version", version(hello.protocol_minor),
                  version(oldest_minor) + " or later (rebuild the adapter)");
    report.demand(hello.role == expected.role, "role", role_name(hello.role),
                  role_name(expected.role));
    report.demand(expected.adapter.empty() || hello.adapter == expected.adapter, "adapter",
                  hello.adapter, expected.adapter);
    report.demand(hello.dimension == expected.dimension || hello.dimension == both_dimensions,
                  "dimension", std::to_string(hello.dimension), std::to_string(expected.dimension));
    report.demand(hello.ranks == expected.ranks, "number of ranks", std::to_string(hello.ranks),
                  std::to_string(expected.ranks));
    // Found where a program was started by hand on another run folder: it would read other files.
    report.demand(hello.case_hash.empty() || hello.case_hash == expected.case_hash,
                  "hash of the resolved case", hello.case_hash,
                  expected.case_hash + " (was it started on another run folder?)");
    // Capabilities count only where this case needs them.
    report.demand(!expected.effective_inertia || hello.capabilities.effective_inertia,
                  "support for effective inertia", "absent",
                  "it for coupling.scheme: " + expected.scheme + " (or use split)");
    report.demand(!expected.restores_within_window || hello.capabilities.restores_within_window,
                  "repetition of a window", "absent",
                  "it for coupling.scheme: " + expected.scheme + " (or use split)");
    for (const std::string& shape : expected.shapes)
        report.demand(contains(hello.capabilities.shapes, shape), "list of shapes",
                      joined(hello.capabilities.shapes), shape);
    return report.sentences_;
}

}  // namespace turbidite
