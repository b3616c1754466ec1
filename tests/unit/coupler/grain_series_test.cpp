// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/grain_series.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

std::string slurp(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

// A viewer may open the series at any moment of a run: after every write it must end with its end tags, once, and name every
// file so far.
TEST(GrainSeries, IsCompleteAfterEveryWrite) {
    const TestFolder folder("series");
    GrainSeries series(folder.path(), {{"disc", {}}});
    const Motion state{test_population(), {}};
    for (int step = 0; step < 3; ++step) {
        series.write(0.5 * step, 10 * step, 0.01, state, {});
        const std::string text = slurp(folder.path() / "grains.pvd");
        const std::string end = "</Collection>\n</VTKFile>\n";
        ASSERT_GE(text.size(), end.size());
        EXPECT_EQ(text.find(end), text.size() - end.size()) << text;
        for (int k = 0; k <= step; ++k) {
            const std::string name = "grains_000000" + std::to_string(k) + "0.vtp";
            EXPECT_NE(text.find("file=\"" + name + "\""), std::string::npos) << text;
            EXPECT_TRUE(std::filesystem::exists(folder.path() / name));
        }
    }
    EXPECT_NE(slurp(folder.path() / "grains.pvd").find("timestep=\"1\""), std::string::npos);
}

}  // namespace
}  // namespace turbidite
