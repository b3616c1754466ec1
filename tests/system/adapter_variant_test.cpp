// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The cost of a new grains adapter: its program, one entry in the table, and this test. `turbidite`
// and `turbidite-coupler` are linked with the longer table, and are otherwise those shipped.
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const a_dry_fall = R"(
domain: {size: [8, 8]}
grains: {adapter: falling, generator: lattice, region: [4, 4]}
fluid: {enabled: false}
time: {step: 0.01, end: 1}
output: {interval: 0.5}
)";

class AdapterVariant : public ShellTest {
 protected:
    void SetUp() override { scratch.write("case.yaml", a_dry_fall); }

    Answer call(const std::string& program, const std::string& arguments) const {
        return shell(program + " " + arguments);
    }
};

// v = g t in units of sqrt(g D), for any time integration with a constant force.
TEST_F(AdapterVariant, RunsUnderItsName) {
    const Answer answer = call(VARIANT_PROGRAM, "run case.yaml" + into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    const Columns history = columns_of(text(run_folder() / "history.csv"));
    EXPECT_NEAR(history.at("mean_velocity_y").back(), -1.0, 1e-9);
    EXPECT_EQ(history.at("contacts").back(), 0.0);
    EXPECT_SAYS(answer.out, "grains rank 0  falling in script");
}

TEST_F(AdapterVariant, IsInTheHelpAndKeptToWhatItCan) {
    EXPECT_SAYS(call(VARIANT_PROGRAM, "keys").out, "grains that touch nothing");
    const Answer triangles = call(VARIANT_PROGRAM, "check case.yaml --set grains.shape=triangle");
    EXPECT_EQ(triangles.code, 2);
    EXPECT_SAYS(triangles.err, "falling");
    const Answer joint = call(VARIANT_PROGRAM,
                              "check case.yaml --set fluid.enabled=true --set fluid.reynolds=10 "
                              "--set coupling.scheme=joint");
    EXPECT_EQ(joint.code, 2);
    EXPECT_SAYS(joint.err, "joint");
}

TEST_F(AdapterVariant, IsUnknownToTheShippedProgram) {
    const Answer answer = call(TURBIDITE_PROGRAM, "check case.yaml");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "grains.adapter = falling");
}

}  // namespace
}  // namespace turbidite
