// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grains and rows of cells that grow above them: a grain that rises into such rows ends the run, or
// goes on rising where the case allows it.
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

/// Discs lighter than the fluid in 6 x 16 D; above 5 D rows grow by 3 %.
const char* const rising = R"(
domain: {size: [6, 16]}
grains: {adapter: standalone-nscd, file: discs.csv, density_ratio: 0.7}
fluid:
  reynolds: 30
  cells_per_diameter: 8
  stretch_ratio: 1.03
  stretch_from: 5
coupling: {scheme: joint}
scales: {kind: avalanche}
time: {step: 0.02, end: 16}
output: {interval: 2}
)";

class StretchedRows : public ShellTest {
 protected:
    Answer play(const std::string& changes = "") {
        scratch.write("case.yaml", rising);
        scratch.write("discs.csv", "id,x,y\n3,1.6,1.5\n8,4.13,3.2\n");
        return shell(std::string(TURBIDITE_PROGRAM) + " run case.yaml --force --out run" + changes);
    }

    double height() {
        return columns_of(text(run_folder() / "history.csv")).at("mean_position_y").back();
    }
};

TEST_F(StretchedRows, AGrainThatReachesThemEndsTheRun) {
    for (const char* ranks : {"1", "2"}) {
        const Answer answer = play(std::string(" --set fluid.ranks=") + ranks);
        EXPECT_EQ(answer.code, 6);
        for (const char* said : {"grain 8 reaches y = 5.0", "stretched above 5 D",
                                 "fluid.stretch_from", "fluid.allow_coarse"})
            EXPECT_SAYS(answer.err, said);
        EXPECT_LT(height(), 5.0);
    }
}

/// Rows of the same case without stretching resolve the discs everywhere.
TEST_F(StretchedRows, AllowedGrainsRiseInThemAsInEqualRows) {
    const Answer coarse = play(" --set fluid.allow_coarse=true");
    ASSERT_EQ(coarse.code, 0) << coarse.err;
    const double in_stretched = height();
    EXPECT_LT(record().at("maxima").at("fluid_balance").get<double>(), 1e-10);
    const Answer equal = play(" --set fluid.stretch_ratio=1");
    ASSERT_EQ(equal.code, 0) << equal.err;
    EXPECT_GT(height(), 5.5);  // the mean of both; the upper one is more than 1 D above 5 D
    EXPECT_NEAR(in_stretched, height(), 0.01 * (height() - 2.35));
}

}  // namespace
}  // namespace turbidite
