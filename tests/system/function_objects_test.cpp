// SPDX-License-Identifier: LGPL-2.1-or-later
//
// OpenFOAM's function objects in a run (fluid.functions): what they see of a window, when, on any
// number of ranks and after a resumption, and how a wrong one is refused.
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

constexpr auto plane = R"(
domain: {size: [4, 4], left: wall, right: wall, bottom: wall, top: wall}
grains: {adapter: standalone-nscd, file: grains.csv, density_ratio: 1.5}
fluid: {reynolds: 36, cells_per_diameter: 8, functions: mine/all}
time: {step: 0.0125, end: 0.25}
output: {interval: 0.0125, fields_interval: 0.125, probes: [1.0625, 1.5625]}
)";

constexpr auto space = R"(
dimension: 3
domain: {size: [2, 2, 2], left: cyclic, right: cyclic, front: cyclic, back: cyclic}
grains: {adapter: standalone-nscd, file: grains.csv, density_ratio: 3}
fluid: {reynolds: 20, cells_per_diameter: 8, splitting: explicit-multiplier, functions: mine/all}
scales: {kind: avalanche}
time: {step: 0.02, end: 0.4}
output: {interval: 0.02, fields_interval: 0.2, probes: [1.0625, 1.5625, 0.4375]}
)";

constexpr auto objects = R"(
// Braces { in comments, and a file beside this one:
#include "parts/points"
average
{
    type fieldAverage; libs (fieldFunctionObjects);
    writeControl writeTime;
    fields (U { mean on; prime2Mean off; base time; });
}
force
{
    type volFieldValue; libs (fieldFunctionObjects);
    fields (lambda); operation volIntegrate; regionType all; writeFields no;
}
seldom
{
    type volFieldValue; libs (fieldFunctionObjects); writeControl timeStep; writeInterval 8;
    fields (U); operation volIntegrate; regionType all; writeFields no;
}
late
{
    type volFieldValue; libs (fieldFunctionObjects); writeControl runTime; writeInterval 0.06;
    fields (U); operation volIntegrate; regionType all; writeFields no;
}
)";

std::string points(const std::string& place) {
    return "points { type probes; libs (sampling); fields (U p); probeLocations ((" + place +
           ")); }\n";
}

using Rows = std::vector<std::vector<double>>;

/// The numbers of the lines of a file of OpenFOAM, without comments.
Rows rows_of(std::string file) {
    for (char& c : file)
        if (c == '(' || c == ')' || c == '\t') c = ' ';
    std::istringstream lines(file);
    Rows rows;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream numbers(line);
        rows.emplace_back();
        for (double number; numbers >> number;) rows.back().push_back(number);
    }
    return rows;
}

class FunctionObjects : public ShellTest {
 protected:
    void SetUp() override {
        std::filesystem::create_directories(scratch.path() / "mine/parts");
        scratch.write("mine/all", objects);
    }
    void in_the_plane() const {
        scratch.write("case.yaml", plane);
        scratch.write("grains.csv", "id,x,y\n0,2,2.6\n1,1.2,1.2\n");
        scratch.write("mine/parts/points", points("1.0625 1.5625 0.05"));
    }
    void in_space() const {
        scratch.write("case.yaml", space);
        scratch.write("grains.csv", "id,x,y,z\n0,1,1.2,1\n");
        scratch.write("mine/parts/points", points("1.0625 1.5625 0.4375"));
    }

    Answer turbidite(const std::string& words) const {
        return shell(std::string(TURBIDITE_PROGRAM) + " " + words);
    }
    std::filesystem::path fluid(const std::string& run) const {
        return scratch.path() / run / "fluid";
    }
    /// What an object wrote from that time on.
    Rows written(const std::string& run, const std::string& file) const {
        return rows_of(text(fluid(run) / "postProcessing" / file));
    }
    Columns table(const std::string& run, const char* name) const {
        return columns_of(text(scratch.path() / run / name));
    }
    /// A field of vectors as OpenFOAM wrote it.
    std::vector<double> field(const std::string& run, const std::string& name) const {
        const std::string file = text(fluid(run) / name);
        const std::size_t open = file.find('(', file.find("nonuniform"));
        if (open == std::string::npos) return {};
        const std::string count = file.substr(file.find('>') + 1, open - file.find('>') - 1);
        std::vector<double> values(3 * std::stoul(count));
        std::memcpy(values.data(), file.data() + open + 1, 8 * values.size());
        return values;
    }

    /// Both read the same cell: of every window, at its end.
    void expect_our_probes(const std::string& run, std::size_t windows, int dimension) const {
        const Rows U = written(run, "points/0/U"), p = written(run, "points/0/p");
        const Columns ours = table(run, "probes.csv");
        ASSERT_EQ(U.size(), windows);
        ASSERT_EQ(p.size(), windows);
        ASSERT_EQ(ours.at("time").size(), windows);
        const char* const names[] = {"velocity_x_1", "velocity_y_1", "velocity_z_1"};
        for (std::size_t row = 0; row < windows; ++row) {
            EXPECT_NEAR(U[row][0], ours.at("time")[row], 1e-9);
            for (int axis = 0; axis < dimension; ++axis)
                EXPECT_NEAR(U[row][1 + static_cast<std::size_t>(axis)], ours.at(names[axis])[row],
                            1e-9);
            EXPECT_NEAR(p[row][1], ours.at("pressure_1")[row], 1e-8 * std::abs(p[row][1]) + 1e-12);
        }
        EXPECT_GT(largest(ours.at("velocity_y_1")), 1e-3);
    }

    /// Of the windows that end with `last`, by the probe, over the first `windows`.
    void expect_the_mean(const std::string& run, const std::string& time, std::size_t cell,
                         std::size_t windows) const {
        const std::vector<double> mean = field(run, time + "/UMean");
        ASSERT_GT(mean.size(), 3 * cell);
        const std::vector<double> each = table(run, "probes.csv").at("velocity_y_1");
        const auto end = each.begin() + static_cast<std::ptrdiff_t>(windows);
        const double expected =
            std::accumulate(each.begin(), end, 0.0) / static_cast<double>(windows);
        EXPECT_NEAR(mean[3 * cell + 1], expected, 1e-9) << run << " " << time;
        EXPECT_GT(std::abs(expected), 1e-4);
    }
};

TEST_F(FunctionObjects, SeeEveryWindowOfThePlaneAtItsEnd) {
    in_the_plane();
    const Answer answer = turbidite("run case.yaml --out run");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out + answer.err, "function objects: points, average, force, seldom, late");
    expect_our_probes("run", 20, 2);
    expect_the_mean("run", "0.125", 8 + 32 * 12, 10);
    expect_the_mean("run", "0.25", 8 + 32 * 12, 20);
    // Every eighth window, and the first at or after multiples of an interval.
    const Rows seldom = written("run", "seldom/0/volFieldValue.dat");
    ASSERT_EQ(seldom.size(), 2u);
    EXPECT_NEAR(seldom[0][0], 0.1, 1e-9);
    EXPECT_NEAR(seldom[1][0], 0.2, 1e-9);
    std::vector<double> times;
    for (const auto& row : written("run", "late/0/volFieldValue.dat")) times.push_back(row[0]);
    ASSERT_EQ(times.size(), 4u);
    EXPECT_NEAR(times[0], 0.0625, 1e-9);
    EXPECT_NEAR(times[3], 0.2375, 1e-9);
    // The run folder has all of it.
    std::filesystem::remove_all(scratch.path() / "mine");
    EXPECT_EQ(turbidite("resume run --set time.end=0.3").code, 0);
}

TEST_F(FunctionObjects, SeeTheForceOnGrains) {
    in_the_plane();
    ASSERT_EQ(turbidite("run case.yaml --out run").code, 0);
    const Rows force = written("run", "force/0/volFieldValue.dat");
    const Columns history = table("run", "history.csv");
    const std::vector<double>&ours = history.at("fluid_force_y"),
          &v = history.at("mean_velocity_y");
    ASSERT_EQ(force.size(), 20u);
    ASSERT_EQ(ours.size(), 21u);
    // The integral of lambda over the thickness of the mesh, and rho_f V dU/dt of two discs.
    const double cell = 1.0 / 8.0, volumes = 2.0 * M_PI / 4.0, step = 0.0125;
    for (std::size_t window = 0; window < 20; ++window) {
        EXPECT_GT(std::abs(force[window][2] / cell), 0.2) << window;
        EXPECT_NEAR(force[window][2] / cell + volumes * (v[window + 1] - v[window]) / step,
                    ours[window + 1], 1e-6)
            << window;
    }
}

TEST_F(FunctionObjects, SeeEveryWindowOfSpaceAtItsEnd) {
    in_space();
    const Answer answer = turbidite("run case.yaml --out run");
    ASSERT_EQ(answer.code, 0) << answer.err;
    expect_our_probes("run", 20, 3);
    expect_the_mean("run", "0.4", 8 + 16 * (12 + 16 * 3), 20);
}

TEST_F(FunctionObjects, RunOnTwoRanks) {
    for (const bool three : {false, true}) {
        three ? in_space() : in_the_plane();
        const std::string out = three ? "two3" : "two2";
        const Answer answer = turbidite("run case.yaml --set fluid.ranks=2 --out " + out);
        ASSERT_EQ(answer.code, 0) << answer.err;
        expect_our_probes(out, 20, three ? 3 : 2);
        EXPECT_EQ(written(out, "force/0/volFieldValue.dat").size(), 20u);
        EXPECT_TRUE(std::filesystem::exists(
            fluid(out) / (three ? "processor1/0.4/UMean" : "processor1/0.25/UMean")));
    }
}

TEST_F(FunctionObjects, GoOnInAResumedRun) {
    in_the_plane();
    ASSERT_EQ(turbidite("run case.yaml --out whole").code, 0);
    ASSERT_EQ(turbidite("run case.yaml --out parts --set time.end=0.125").code, 0);
    const Answer more = turbidite("resume parts --set time.end=0.25");
    ASSERT_EQ(more.code, 0) << more.err;
    const Rows whole = written("whole", "points/0/U"), first = written("parts", "points/0/U"),
               second = written("parts", "points/0.125/U");
    ASSERT_EQ(first.size(), 10u) << "it stays";
    ASSERT_EQ(second.size(), 10u);
    for (std::size_t row = 0; row < 10; ++row) {
        EXPECT_EQ(first[row], whole[row]);
        EXPECT_EQ(second[row], whole[10 + row]);
    }
    const std::vector<double> once = field("whole", "0.25/UMean");
    ASSERT_FALSE(once.empty());
    EXPECT_LT(largest_difference(once, field("parts", "0.25/UMean")), 1e-12);
    EXPECT_EQ(lines_of_history("whole"), lines_of_history("parts"));
}

/// They look and change nothing.
TEST_F(FunctionObjects, LeaveTheRunAsItIs) {
    for (const bool three : {false, true}) {
        three ? in_space() : in_the_plane();
        const std::string end = three ? "3" : "2";
        ASSERT_EQ(turbidite("run case.yaml --out seen" + end).code, 0);
        ASSERT_EQ(turbidite("run case.yaml --set fluid.functions=~ --out alone" + end).code, 0);
        EXPECT_EQ(lines_of_history("seen" + end), lines_of_history("alone" + end));
    }
}

TEST_F(FunctionObjects, OfALibraryOfOnesOwn) {
    in_the_plane();
    scratch.write("mine/all", std::string("mine { type greatestSpeed; libs (\"") +
                                  GREATEST_SPEED_LIBRARY + "\"); }\n");
    const Answer answer = turbidite("run case.yaml --out run");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const std::string log = text(scratch.path() / "run/logs/fluid.log");
    EXPECT_SAYS(log, "greatest speed at 0.0125: ");
    EXPECT_SAYS(log, "greatest speed at 0.25: ");
}

TEST_F(FunctionObjects, ThatCannotBeMadeEndTheRunByName) {
    in_the_plane();
    const std::pair<const char*, const char*> faults[] = {
        {"a { type nothing; libs (sampling); }", "nothing"},
        {"a { type probes; libs (nowhere); }", "the library nowhere of a cannot be loaded"},
        {"a { type probes; libs (sampling); fields (U); }", "probeLocations"}};
    for (const auto& [file, says] : faults) {
        scratch.write("mine/all", file);
        const Answer answer = turbidite("run case.yaml --force --out run");
        EXPECT_EQ(answer.code, 4) << file;
        EXPECT_SAYS(answer.err, "fluid.functions: ");
        EXPECT_SAYS(answer.err, says);
    }
    // Mended in the run folder, it can go on.
    scratch.write("run/fluid/system/functions", points("1 1 0.05"));
    EXPECT_EQ(turbidite("resume run").code, 0);
    EXPECT_EQ(written("run", "points/0/U").size(), 20u);
}

// A probe outside the mesh writes nothing, and OpenFOAM goes on.
TEST_F(FunctionObjects, ThatFindNothingAreToldAtTheEnd) {
    in_the_plane();
    scratch.write("mine/all", points("1000 1 0.05"));
    const Answer answer = turbidite("run case.yaml --out run");
    EXPECT_EQ(answer.code, 0) << answer.err;
    const std::string told =
        "OpenFOAM warned once in logs/fluid.log: \"Did not find location (1000 1 0.05)";
    EXPECT_SAYS(answer.err, "turbidite: warning: " + told);
    const auto warnings =
        nlohmann::json::parse(text(scratch.path() / "run/run.json")).at("warnings");
    ASSERT_EQ(warnings.size(), 1u) << warnings;
    EXPECT_EQ(warnings[0].at("about"), "openfoam");
    EXPECT_SAYS(warnings[0].at("text").get<std::string>(), told);
}

TEST_F(FunctionObjects, FaultsOfTheFileAreFoundBeforeTheStart) {
    in_the_plane();
    const std::pair<const char*, const char*> faults[] = {
        {"\na { type probes;", "all line 2: fluid.functions opens a brace that is not closed"},
        {"a { type probes; } }", "closes a brace that is not open"},
        {"a { type \"probes; }", "begins a string that does not end"},
        {"/* a { }", "begins a comment that does not end"},
        {"functions { a { type probes; } }", "has an entry functions of its own"},
        {"type probes;", "has no function object"},
        {"a {\n#include \"gone\"\n}", "all line 2: fluid.functions includes "},
        {"#include \"all\"", "is included more than 10 files deep"},
        {"a { type coded; code #{ } } #}; }", "all line 1: fluid.functions has type coded"},
        {"a { x #calc \"1 + 1\"; }", "has #calc"}};
    for (const auto& [file, says] : faults) {
        scratch.write("mine/all", file);
        const Answer answer = turbidite("check case.yaml");
        EXPECT_EQ(answer.code, 2) << file;
        EXPECT_SAYS(answer.err, says);
    }
    const Answer missing = turbidite("check case.yaml --set fluid.functions=gone");
    EXPECT_EQ(missing.code, 2);
    EXPECT_SAYS(missing.err, "fluid.functions = gone");
    EXPECT_SAYS(missing.err, "There is no file");
}

}  // namespace
}  // namespace turbidite
