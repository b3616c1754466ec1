// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact laws in whole runs, dry and coupled: a column of touching discs collapses in a wider box,
// more slowly with every attractive law. With a law that attracts or has states, the impulses on
// the grains balance their change of momentum in every window (column grain_balance, checked by the
// hub).
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const the_case = R"(
domain: {size: [11, 8]}
grains:
  adapter: standalone-nscd
  generator: lattice
  region: [5, 7]
  jitter: 0.0005
  density_ratio: 1.5
fluid: {reynolds: 36, cells_per_diameter: 4}
contact:
  friction: 0.3
  law: static-dynamic
  static_friction: 0.5
  impact: moreau
  restitution: 0.5
  adhesion: capillary
  adhesion_force: 0.3
  adhesion_range: 0.1
  adhesion_length: 0.05
scales: {kind: avalanche}
time: {step: 0.0125, end: 5}
output: {interval: 0.5}
)";

constexpr std::size_t grains = 32;

class LawsInRuns : public ShellTest {
 protected:
    Columns play(const std::string& changes) {
        scratch.write("case.yaml", the_case);
        const Answer answer = shell(std::string(TURBIDITE_PROGRAM) +
                                    " run case.yaml --force --out run --set " + changes);
        EXPECT_EQ(answer.code, 0) << changes << answer.out << answer.err;
        if (answer.code != 0) return {};
        EXPECT_EQ(record().at("windows_done"), 400);
        return columns_of(text(run_folder() / "history.csv"));
    }

    double maximum(const char* name) const { return record().at("maxima").value(name, 1.0); }
};

TEST_F(LawsInRuns, GrainsBalanceUnderSplitAndJoint) {
    for (const char* scheme : {"split", "joint"}) {
        const Columns history = play(std::string("coupling.scheme=") + scheme);
        EXPECT_LT(maximum("grain_balance"), 1e-12) << scheme;
        for (std::size_t row = 1; row < history.at("contacts").size(); ++row)
            EXPECT_GT(history.at("contacts")[row], grains) << scheme << " row " << row;
    }
}

TEST_F(LawsInRuns, DryWithEveryAdhesion) {
    const std::string dry = "fluid.enabled=false --set contact.adhesion=";
    const std::vector<const char*> adhesions = {"none", "capillary", "wet", "wet-irreversible",
                                                "cohesion --set contact.adhesion_shear=1"};
    std::vector<double> heights, speeds;
    for (const char* adhesion : adhesions) {
        const Columns history = play(dry + adhesion);
        EXPECT_LT(maximum("penetration"), 1e-3) << adhesion;
        EXPECT_GT(largest(history.at("contacts")), grains) << adhesion;
        heights.push_back(history.at("mean_position_y")[5]);  // 2.5 t_c
        speeds.push_back(history.at("mean_velocity_x").back());
    }
    // Every attraction slows the column down, and no two laws act alike: with a range that contacts
    // enter later, `wet` gives another result than `wet-irreversible`.
    for (std::size_t i = 1; i < adhesions.size(); ++i) {
        EXPECT_GT(heights[i], heights[0] + 0.015) << adhesions[i];  // D
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_GT(std::abs(speeds[i] - speeds[k]), 1e-3) << adhesions[i] << adhesions[k];
    }
}

TEST_F(LawsInRuns, ALawThatLacksAParameterIsRefusedByName) {
    scratch.write("case.yaml", the_case);
    const Answer answer = shell(std::string(TURBIDITE_PROGRAM) +
                                " check case.yaml --set contact.adhesion=cohesion "
                                "--set contact.solver=jacobi --set contact.friction=-1");
    EXPECT_EQ(answer.code, 2);
    for (const char* said :
         {"contact.adhesion_shear is missing", "contact.solver = jacobi", "contact.friction = -1"})
        EXPECT_SAYS(answer.err, said);
}

const char* const landing = R"(
domain: {size: [4, 4], left: cyclic, right: cyclic}
grains: {adapter: standalone-nscd, file: one.csv, density_ratio: 3}
fluid: {reynolds: 20, cells_per_diameter: 8, splitting: marchuk-yanenko}
contact: {film: lubrication, film_roughness: 0.01}
scales: {kind: avalanche}
time: {step: 0.01, end: 2}
output: {interval: 0.02}
checkpoint: {interval: 1}
)";

/// When the disc is within 0.002 D of the floor; the end of the run if it does not get there.
double arrival(const Columns& run) {
    std::size_t row = 0;
    while (row + 1 < run.at("time").size() && run.at("mean_position_y")[row] > 0.502) ++row;
    return run.at("time")[row];
}

class FilmsOfDiscs : public ShellTest {
 protected:
    void SetUp() override {
        scratch.write("case.yaml", landing);
        scratch.write("one.csv", "id,x,y,vy\n1,2,0.75,-0.5\n");
    }

    Columns play(const std::string& command, const std::string& folder) {
        const Answer answer = shell(std::string(TURBIDITE_PROGRAM) + " " + command);
        EXPECT_EQ(answer.code, 0) << command << answer.out << answer.err;
        return columns_of(text(scratch.path() / folder / "history.csv"));
    }
};

// A disc that falls on the floor slows down in its film, whose work is told, in both hosts; a run
// in two parts has the bits of one.
TEST_F(FilmsOfDiscs, SlowWhatLands) {
    const std::string run = "run case.yaml --out ";
    const Columns bare = play(run + "bare --set contact.film=none", "bare");
    const Columns filmed = play(run + "filmed", "filmed");
    const Columns in_yade = play(run + "yade --set grains.adapter=yade-nscd", "yade");
    EXPECT_TRUE(std::isnan(bare.at("film_work").back())) << "empty without films";
    double work = 0.0;
    for (const double part : filmed.at("film_work")) work += std::isnan(part) ? 0.0 : part;
    EXPECT_LT(work, -1e-3);
    EXPECT_GT(arrival(filmed), arrival(bare) + 0.05);
    EXPECT_LT(arrival(filmed), 2.0) << "it lands";
    EXPECT_GT(filmed.at("contacts").back(), 0.0);
    for (std::size_t row = 0; row < filmed.at("time").size(); ++row)
        EXPECT_NEAR(filmed.at("mean_position_y")[row], in_yade.at("mean_position_y")[row], 1e-9);
    play(run + "parts --set time.end=1", "parts");
    const Columns parts = play("resume parts --set time.end=2", "parts");
    EXPECT_EQ(parts.at("mean_position_y"), filmed.at("mean_position_y"));
}

}  // namespace
}  // namespace turbidite
