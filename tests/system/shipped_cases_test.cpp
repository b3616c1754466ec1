// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every case that is shipped plays its first windows, within all limits.
#include <yaml-cpp/yaml.h>

#include <iomanip>
#include <regex>

#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

/// Cases, that is files with a time step, in configs and configs/validation; other files are
/// studies.
std::vector<fs::path> shipped_cases() {
    std::vector<fs::path> found;
    for (const char* folder : {"configs", "configs/validation"})
        for (const auto& entry : fs::directory_iterator(fs::path(TURBIDITE_SOURCE_DIR) / folder)) {
            if (entry.path().extension() != ".yaml") continue;
            std::ifstream input(entry.path());
            const std::string yaml{std::istreambuf_iterator<char>(input), {}};
            if (yaml.find("\n  step:") != std::string::npos) found.push_back(entry.path());
        }
    std::sort(found.begin(), found.end());
    return found;
}

YAML::Node expected() {
    return YAML::LoadFile(TURBIDITE_SOURCE_DIR "/configs/expected.yaml");
}

/// Its name in configs/expected.yaml: "silo", "validation/rebound".
std::string entry_of(const fs::path& file) {
    const fs::path name = fs::relative(file, fs::path(TURBIDITE_SOURCE_DIR) / "configs");
    return name.parent_path() / name.stem();
}

// A user who plays one sees the grains in YADE; those of validation need no host.
TEST(ShippedCases, HaveTheirGrainsInYade) {
    int cases = 0;
    for (const fs::path& file : shipped_cases()) {
        if (file.parent_path().filename() == "validation") continue;
        const YAML::Node grains = YAML::LoadFile(file.string())["grains"];
        EXPECT_EQ(grains["adapter"].as<std::string>("yade-nscd"), "yade-nscd") << file;
        ++cases;
    }
    EXPECT_GT(cases, 15);
}

class ShippedCase : public ShellTest, public ::testing::WithParamInterface<fs::path> {};

TEST_P(ShippedCase, PlaysItsFirstWindows) {
    static const std::regex time_step("\n  step: +([0-9.e-]+)");
    const std::string yaml = text(GetParam());
    std::smatch match;
    ASSERT_TRUE(std::regex_search(yaml, match, time_step));
    const std::string step = match[1].str();
    std::ostringstream line;
    line << "XDG_CACHE_HOME=" << scratch.path().string()
         << " timeout 100 " TURBIDITE_PROGRAM " run " << GetParam().string() << " --out run"
         << std::setprecision(12) << " --set time.end=" << 3.0 * std::stod(step)
         << " --set output.interval=" << step;
    for (const auto& key : expected()[entry_of(GetParam())]["small"])
        line << " --set '" << key.first.Scalar() << '=' << YAML::Dump(key.second) << "'";
    const Answer answer = shell(line.str());
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_EQ(rows_of_history(), 4);
    if (answer.code != 0) return;
    // All of them fit into memory with OpenFOAM's mesh.
    const bool dry = record().at("fluid_program").is_null();
    EXPECT_EQ(dry, !fs::exists(run_folder() / "fluid"));
    EXPECT_TRUE(dry || record().at("fluid_program") == "openfoam");
}

std::string name_of(const ::testing::TestParamInfo<fs::path>& info) {
    std::string name = info.param.stem();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Configs, ShippedCase, ::testing::ValuesIn(shipped_cases()), name_of);

TEST(ShippedCases, AllAreInTheGallery) {
    const YAML::Node entries = expected();
    for (const fs::path& file : shipped_cases())
        EXPECT_TRUE(entries[entry_of(file)].IsDefined()) << file << " has no entry";
}

TEST(ShippedCases, AreMany) {
    EXPECT_GE(shipped_cases().size(), 20u);
}

}  // namespace
}  // namespace turbidite
