// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The files of a run take what was predicted before it. Measured 0.94 to 1.12 times as much.
#include "launcher/case/forecast/disk_cost.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

const char* const a_column = R"(
domain: {size: [24, 16]}
grains: {adapter: standalone-nscd, generator: lattice, region: [12, 12]}
fluid: {reynolds: 36, cells_per_diameter: 8}
time: {step: 0.02, end: 0.8}
output: {interval: 0.04, fields_interval: 0.32}
checkpoint: {interval: 0.2}
)";

class DiskForecast : public ShellTest {
 protected:
    /// Bytes of all files of a run with these changes over those that were predicted.
    double measured_over_predicted(const std::vector<std::string>& changes) {
        scratch.write("case.yaml", a_column);
        std::string line = std::string(TURBIDITE_PROGRAM) + " run case.yaml --force --out run";
        for (const std::string& change : changes) line += " --set '" + change + "'";
        const Answer answer = shell(line);
        EXPECT_EQ(answer.code, 0) << answer.err;
        const fs::path run = scratch.path() / "run";
        EXPECT_EQ(fs::exists(run / "fluid/constant"),
                  answer.out.find("fluid.foam") < std::string::npos);
        double bytes = 0.0;
        for (const auto& entry : fs::recursive_directory_iterator(run))
            if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
        return bytes / (1e9 * predicted_disk(load_case(scratch.path() / "case.yaml", changes)));
    }
};

TEST_F(DiskForecast, OfAColumnInALiquid) {
    EXPECT_NEAR(measured_over_predicted({}), 1.0, 0.2);
    EXPECT_NEAR(measured_over_predicted({"fluid.ranks=2"}), 1.0, 0.2);
    EXPECT_NEAR(measured_over_predicted({"output.fields=vorticity solid"}), 1.0, 0.2);
}

TEST_F(DiskForecast, OfDryGrains) {
    std::vector<std::string> dry{"fluid.enabled=false", "time.end=8"};
    EXPECT_NEAR(measured_over_predicted(dry), 1.0, 0.2);
    dry.insert(dry.end(), {"grains.generator=random", "grains.shape=triangle", "grains.count=50"});
    EXPECT_NEAR(measured_over_predicted(dry), 1.0, 0.2);
}

}  // namespace
}  // namespace turbidite
