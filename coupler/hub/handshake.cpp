// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/handshake.hpp"

#include "coupler/protocol/failure.hpp"

namespace turbidite {

Expectation expectation(Role role, const Settings& settings, const ShapeTable& shapes,
                        const SchemeEntry& scheme) {
    const bool grains = role == Role::grains;
    Expectation expected;
    expected.role = role;
    // Only shipped grains adapters are known by name; fluids and users' programs have any.
    const bool any = !grains || settings.text("grains.adapter") == users_program;
    expected.adapter = any ? "" : settings.text("grains.adapter");
    expected.dimension = static_cast<std::int32_t>(settings.integer("dimension"));
    expected.ranks =
        static_cast<std::int32_t>(settings.integer(grains ? "grains.ranks" : "fluid.ranks"));
    expected.case_hash = settings.text("run.hash");
    expected.scheme = scheme.name;
    expected.restores_within_window = grains && scheme.repeats;
    // Grains that repeat their windows take only velocities from the responses.
    expected.effective_inertia = grains ? scheme.needs_inertia() : scheme.has_responses();
    for (const ShapeRecord& shape : shapes) expected.shapes.push_back(shape.kind);
    return expected;
}

void shake_hands(const std::vector<ParticipantLink*>& links, const Settings& settings,
                 const ShapeTable& shapes, const SchemeEntry& scheme, Watch& watch) {
    // Collected from all ranks: the user mends everything at once.
    std::string report;
    for (ParticipantLink* link : links) {
        watch.wait_for(*link, Kind::hello);
        const Expectation expected = expectation(link->role(), settings, shapes, scheme);
        const std::vector<Hello> hellos = link->take<Hello>(Kind::hello);
        for (int rank = 0; rank < link->ranks(); ++rank) {
            link->set_hello(rank, hellos[rank]);
            for (const std::string& sentence : mismatches(link->hello(rank), expected))
                report += "\n  " + sentence;
        }
    }
    if (!report.empty())
        throw Failure(ExitCode::handshake_refused,
                      "the programs of the job are incompatible:" + report);
}

}  // namespace turbidite
