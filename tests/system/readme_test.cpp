// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The README's next steps are a chain of commands that works as it is printed, in its order. Only
// the case that `new` writes is made shorter, and studies of hours are checked instead of run.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class Readme : public ShellTest {
 protected:
    /// The commands of a section's block, without comments and without `./turbidite `.
    std::vector<std::string> commands(const std::string& section) const {
        std::istringstream lines(text(TURBIDITE_SOURCE_DIR "/README.md"));
        std::vector<std::string> found;
        bool inside = false;
        const std::string begin = "./turbidite ";
        for (std::string line; std::getline(lines, line);) {
            if (line.rfind("## ", 0) == 0) inside = line == "## " + section;
            if (!inside || line.rfind(begin, 0) != 0) continue;
            line = line.substr(begin.size(), line.find("#") - begin.size());
            found.push_back(line.substr(0, line.find_last_not_of(' ') + 1));
        }
        return found;
    }

    void shorten(const std::string& file) const {
        std::string text = this->text(scratch.path() / file);
        for (const auto& [from, to] :
             {std::pair{"end: 60", "end: 4"}, {"interval: 1.5", "interval: 0.25"}}) {
            const auto at = text.find(from);
            ASSERT_NE(at, std::string::npos) << from;
            text.replace(at, std::string(from).size(), to);
        }
        scratch.write(file, text);
    }

    /// As by Ctrl-C, when a third of it is done.
    Answer interrupted(const std::string& command, const std::string& run) const {
        const pid_t job = begin(command);
        const std::filesystem::path history = scratch.path() / run / "history.csv";
        for (int tenth = 0; tenth < 1200; ++tenth) {
            const std::string rows = text(history);
            if (std::count(rows.begin(), rows.end(), '\n') > 5) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        ::kill(job, SIGINT);
        return end_of(job);
    }
};

TEST_F(Readme, ItsNextStepsAreAChainThatWorks) {
    std::string all;
    for (const std::string& command : commands("Next steps")) {
        all += command + "\n";
        const std::string line = TURBIDITE_PROGRAM " " + command;
        if (command.rfind("study ", 0) == 0) {
            const Answer answer = shell(TURBIDITE_PROGRAM " check" + command.substr(5));
            EXPECT_EQ(answer.code, 0) << command << answer.err;
        } else if (command.find("--out runs/rough") != std::string::npos) {
            EXPECT_EQ(interrupted(line, "runs/rough").code, 130) << command;
        } else {
            const Answer answer = shell(line);
            EXPECT_EQ(answer.code, 0) << command << "\n" << answer.out << answer.err;
        }
        if (command.rfind("new ", 0) == 0) shorten("my-case.yaml");
    }
    for (const char* part :
         {"new my-case\n", "resume runs/rough\n", "compare runs/rough runs/smooth\n"})
        EXPECT_SAYS(all, part);
    const auto resumed = nlohmann::json::parse(text(scratch.path() / "runs/rough/run.json"));
    EXPECT_EQ(resumed.at("status"), "done");
    ASSERT_EQ(resumed.at("parts").size(), 2u) << "it has to be interrupted";
    EXPECT_EQ(resumed.at("parts")[1].at("versions"), resumed.at("versions"));
}

}  // namespace
}  // namespace turbidite
