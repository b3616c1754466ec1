// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact laws in whole runs, dry and coupled: what grains feel from a law that pulls or remembers
// is what their momentum changes by, in every window (column grain_balance, checked by the hub).
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const the_case = R"(
domain: {size: [8, 8]}
grains: {adapter: standalone-nscd, generator: random, count: 30, density_ratio: 1.5}
fluid: {reynolds: 36, cells_per_diameter: 4}
contact:
  friction: 0.3
  law: static-dynamic
  static_friction: 0.5
  impact: moreau
  restitution: 0.5
  adhesion: capillary
  adhesion_force: 0.5
  adhesion_range: 0.1
  adhesion_length: 0.05
scales: {kind: avalanche}
time: {step: 0.0125, end: 2.5}
output: {interval: 0.5}
)";

class LawsInRuns : public ShellTest {
 protected:
    nlohmann::json maxima(const std::string& changes) {
        scratch.write("case.yaml", the_case);
        const Answer answer = shell(std::string(TURBIDITE_PROGRAM) +
                                    " run case.yaml --force --out run --set " + changes);
        EXPECT_EQ(answer.code, 0) << changes << answer.out << answer.err;
        if (answer.code != 0) return {};
        EXPECT_EQ(record().at("windows_done"), 200);
        return record().at("maxima");
    }
};

TEST_F(LawsInRuns, GrainsBalanceUnderSplitAndJoint) {
    for (const char* scheme : {"split", "joint"})
        EXPECT_LT(maxima(std::string("coupling.scheme=") + scheme).value("grain_balance", 1.0),
                  1e-12)
            << scheme;
}

TEST_F(LawsInRuns, DryWithEveryAdhesion) {
    const std::string dry = "fluid.enabled=false --set contact.adhesion=";
    for (const char* adhesion :
         {"capillary", "wet", "wet-irreversible", "cohesion --set contact.adhesion_shear=1"})
        EXPECT_LT(maxima(dry + adhesion).value("penetration", 1.0), 1e-3) << adhesion;
}

TEST_F(LawsInRuns, ALawThatLacksAParameterIsRefusedByName) {
    scratch.write("case.yaml", the_case);
    const Answer answer = shell(std::string(TURBIDITE_PROGRAM) +
                                " check case.yaml --set contact.adhesion=cohesion "
                                "--set contact.theta=0.7 --set contact.friction=-1");
    EXPECT_EQ(answer.code, 2);
    for (const char* said :
         {"contact.adhesion_shear is missing", "contact.theta = 0.7", "contact.friction = -1"})
        EXPECT_SAYS(answer.err, said);
}

}  // namespace
}  // namespace turbidite
