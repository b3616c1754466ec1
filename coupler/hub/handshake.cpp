// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/handshake.hpp"

#include "coupler/protocol/failure.hpp"

namespace turbidite {

Expectation expectation(Role role, const Settings& settings, const ShapeTable& shapes) {
    const bool grains = role == Role::grains;
    Expectation expected;
    expected.role = role;
    expected.adapter = grains ? settings.text("grains.adapter") : "";
    expected.dimension = static_cast<std::int32_t>(settings.integer("dimension"));
    expected.ranks =
        static_cast<std::int32_t>(settings.integer(grains ? "grains.ranks" : "fluid.ranks"));
    expected.case_hash = settings.text("run.hash");
    expected.scheme = settings.flag("fluid.enabled") ? settings.text("coupling.scheme") : "dry";
    for (const ShapeRecord& shape : shapes) expected.shapes.push_back(shape.kind);
    return expected;
}

void shake_hands(const std::vector<ParticipantLink*>& links, const Settings& settings,
                 const ShapeTable& shapes, Watch& watch) {
    std::string report;
    for (ParticipantLink* link : links) {
        watch.wait_for(*link, Kind::hello);
        const Expectation expected = expectation(link->role(), settings, shapes);
        const std::vector<Hello> hellos = link->take<Hello>(Kind::hello);
        for (int rank = 0; rank < link->ranks(); ++rank) {
            link->set_hello(rank, hellos[rank]);
            for (const std::string& sentence : mismatches(hellos[rank], expected))
                report += "\n  " + sentence;
        }
    }
    if (!report.empty())
        throw Failure(ExitCode::handshake_refused, "the programs do not fit together:" + report);
}

}  // namespace turbidite
