// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite replay: fluid and grains of a recorded job, each alone.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class Replay : public ShellTest {
 protected:
    Answer turbidite(const std::string& arguments) const {
        return shell(std::string(TURBIDITE_PROGRAM) + " " + arguments);
    }
};

TEST_F(Replay, EachSideRepeatsItselfToTheBit) {
    const std::string run = "run " TURBIDITE_SOURCE_DIR
                            "/configs/quickstart.yaml --set time.end=0.5 --set fluid.ranks=2 --out "
                            "run --force";
    ASSERT_EQ(turbidite(run + " --set coupling.recording=both").code, 0);
    for (const std::string side : {"grains", "fluid"}) {
        const Answer answer = turbidite("replay run --side " + side + " --out again-" + side);
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_NE(answer.out.find("40 windows"), std::string::npos) << answer.out;
        EXPECT_NE(answer.out.find("of the " + side + " compared: identical"), std::string::npos)
            << answer.out;
    }
    const Answer both = turbidite("replay run");
    EXPECT_EQ(both.code, 2);
    EXPECT_NE(both.err.find("--side grains or --side fluid"), std::string::npos) << both.err;

    ASSERT_EQ(turbidite(run).code, 0);  // an old recording would be of another run
    const Answer none = turbidite("replay run");
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("coupling.recording"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace turbidite
