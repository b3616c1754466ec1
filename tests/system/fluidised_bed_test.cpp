// SPDX-License-Identifier: LGPL-2.1-or-later
//
// configs/fluidised-bed.yaml, smaller: liquid that enters through the plate below a bed lifts it or
// not, depending on its velocity.
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class FluidisedBed : public ShellTest {
 protected:
    /// Plays the small bed with this velocity of the liquid [u_c].
    Columns play(const std::string& velocity, const std::string& adapter = "standalone-nscd",
                 const std::string& end = "12") {
        const Answer answer =
            shell(std::string(TURBIDITE_PROGRAM) +
                  " run " TURBIDITE_SOURCE_DIR
                  "/configs/fluidised-bed.yaml --force --out run"
                  " --set grains.adapter=" +
                  adapter +
                  " --set domain.size=[8,16]"
                  " --set grains.region=[8,5] --set time.end=" +
                  end + " --set domain.motions.stream.velocity=[0," + velocity + "]");
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        const nlohmann::json maxima = record().at("maxima");
        EXPECT_LT(maxima.at("penetration").get<double>(), 1e-4);  // D
        EXPECT_LT(maxima.at("grain_balance").get<double>(), 1e-12);
        EXPECT_LT(maxima.at("fluid_balance").get<double>(), 1e-10);
        Columns run = columns_of(text(run_folder() / "history.csv"));
        EXPECT_EQ(run.at("grains").back(), run.at("grains").front());
        return run;
    }
};

TEST_F(FluidisedBed, IsLiftedByAFastStreamAndStandsInASlowOne) {
    const Columns fast = play("0.15"), slow = play("0.02", "standalone-nscd", "32");
    const double start = fast.at("mean_position_y").front();
    EXPECT_GT(fast.at("mean_position_y").back(), 1.3 * start);
    // The loose lattice collapses by a tenth, which takes 24 t_c since liquid has to leave, and
    // stands.
    EXPECT_NEAR(slow.at("mean_position_y").back(), 0.895 * start, 0.02 * start);
    EXPECT_LT(slow.at("mean_speed").back(), 1e-3);
    EXPECT_GT(slow.at("coordination").back(), 2.5);  // carried by contacts
    EXPECT_LT(fast.at("coordination").back(), slow.at("coordination").back() - 0.5);
    // The liquid leaves through the top: the same flux through every height.
    EXPECT_NEAR(fast.at("flow_y").back(), 0.15, 0.01);
    EXPECT_NEAR(slow.at("flow_y").back(), 0.02, 0.002);
}

// The plate is a wall in YADE's scene as well: the bed stands on it, as without YADE.
TEST_F(FluidisedBed, StandsOnThePlateInYade) {
    const Columns yade = play("0.02", "yade-nscd", "2"),
                  alone = play("0.02", "standalone-nscd", "2");
    EXPECT_GT(yade.at("coordination").back(), 0.5);
    for (const char* column : {"mean_position_y", "mean_speed", "coordination", "flow_y"})
        EXPECT_NEAR(yade.at(column).back(), alone.at(column).back(), 1e-9) << column;
}

}  // namespace
}  // namespace turbidite
