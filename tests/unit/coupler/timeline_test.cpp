// SPDX-License-Identifier: LGPL-2.1-or-later
//
// output.timeline: the trace of a whole job, of a program that is killed, and of a full file.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "coupler/protocol/timeline.hpp"
#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

using nlohmann::json;
using Part = Timeline::Part;

std::filesystem::path only_file(const TestFolder& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "timeline"))
        files.push_back(entry.path());
    EXPECT_EQ(files.size(), 1u);
    return files.at(0);
}

/// As a viewer reads it: what is missing at the end is added.
json events(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(text.substr(0, 2), "[\n");
    EXPECT_EQ(text.substr(text.size() - 2), ",\n");
    return json::parse(text + "{}]");
}

/// Spans of each (process, thread), in the order of the file.
std::map<std::pair<int, int>, std::vector<json>> spans(const json& all) {
    std::map<std::pair<int, int>, std::vector<json>> by_rank;
    for (const json& event : all)
        if (event.value("ph", "") == "X") by_rank[{event["pid"], event["tid"]}].push_back(event);
    return by_rank;
}

std::set<int> windows_of(const std::vector<json>& of_rank, const std::string& name) {
    std::set<int> windows;
    for (const json& span : of_rank)
        if (span["name"] == name) windows.insert(span["args"]["window"].get<int>());
    return windows;
}

const std::set<int> all_windows{0, 1, 2, 3, 4, 5};

TEST(Timeline, TellsWhenEveryRankComputesWaitsAndTransfers) {
    const TestFolder folder("timeline");
    Job job;
    job.settings.set("output.timeline", true);
    job.grains_ranks = 2;
    job.fluid_ranks = 2;
    job.run(folder);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const auto by_rank = spans(events(only_file(folder)));
    ASSERT_EQ(by_rank.size(), 5u);  // the coupler (process 0), two ranks each of fluid 1, grains 2
    for (const int rank : {0, 1}) {
        EXPECT_EQ(windows_of(by_rank.at({1, rank}), "correct"), all_windows);
        EXPECT_EQ(windows_of(by_rank.at({2, rank}), "apply_kick"), all_windows);
    }
    EXPECT_EQ(windows_of(by_rank.at({0, 0}), "wait for the grains").count(5), 1u);
    for (const auto& [rank, own] : by_rank)
        for (std::size_t i = 1; i < own.size(); ++i)  // without gaps; times have 1 ns
            EXPECT_NEAR(own[i - 1]["ts"].get<double>() + own[i - 1]["dur"].get<double>(),
                        own[i]["ts"].get<double>(), 0.01)
                << own[i];
}

TEST(Timeline, IsOffUnlessAskedFor) {
    const TestFolder folder("no-timeline");
    Job job;
    job.run(folder);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "timeline"));
}

TEST(Timeline, OfAKilledProgramIsReadable) {
    const TestFolder folder("killed-timeline");
    const pid_t child = fork();
    if (child == 0) {
        Timeline timeline(folder.path(), Role::fluid, 3);
        timeline.enter(Part::compute, "advance", 7);
        timeline.enter(Part::wait, "wait for the coupler", 7);
        timeline.flush();
        timeline.enter(Part::compute, "never written", 8);
        ::raise(SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    const auto of_rank = spans(events(only_file(folder))).at({1, 3});
    ASSERT_EQ(of_rank.size(), 2u);  // "start" and "advance"; the wait had not ended
    EXPECT_EQ(of_rank[1]["name"], "advance");
    EXPECT_EQ(of_rank[1]["cat"], "compute");
    EXPECT_EQ(of_rank[1]["args"]["window"], 7);
}

TEST(Timeline, EndsBeforeTheFileIsTooLarge) {
    const TestFolder folder("full-timeline");
    Timeline timeline(folder.path(), Role::grains, 0);
    timeline.flush();
    std::filesystem::resize_file(timeline.file(), Timeline::most_bytes);
    timeline.enter(Part::compute, "advance", 0);
    timeline.flush();
    EXPECT_EQ(std::filesystem::file_size(timeline.file()),
              static_cast<std::uintmax_t>(Timeline::most_bytes));
    timeline.enter(Part::wait, "wait for the coupler", 0);  // the run goes on
    timeline.flush();
}

TEST(Timeline, AFolderThatCannotBeWrittenIsNamed) {
    const TestFolder folder("no-folder-for-timeline");
    std::ofstream(folder.path() / "timeline") << "a file in its place";
    try {
        Timeline timeline(folder.path(), Role::grains, 0);
        FAIL() << "opened " << timeline.file();
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("timeline"), std::string::npos);
    }
}

}  // namespace
}  // namespace turbidite
