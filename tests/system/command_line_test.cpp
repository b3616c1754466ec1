// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The program as seen by the user: exit codes, what is printed where, what a run leaves behind.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <sstream>
#include <thread>

#include "tests/system/program.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

const std::string quickstart = TURBIDITE_SOURCE_DIR "/configs/quickstart.yaml";
// An immersed job with small windows, without YADE.
const std::string small = " --set grains.adapter=standalone-nscd --set fluid.cells_per_diameter=4";
// Dry grains without YADE: the fastest complete job.
const std::string quick = " --set fluid.enabled=false --set grains.adapter=standalone-nscd";

class CommandLine : public ShellTest {
 protected:
    Answer turbidite(const std::string& arguments) const {
        return shell(program + " " + arguments);
    }
};

TEST_F(CommandLine, MisspeltKeyStartsNothing) {
    const Answer answer = turbidite("run " + quickstart + into_run_folder() +
                                    " --set contact.fricton=0.3 --set time.step=-1");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "contact.friction?");
    EXPECT_SAYS(answer.err, "time.step = -1");
    EXPECT_SAYS(answer.err, "2 errors, nothing was started. Exit code 2.");
    EXPECT_FALSE(fs::exists(run_folder()));
}

TEST_F(CommandLine, BadUsage) {
    EXPECT_EQ(turbidite("").code, 2);
    EXPECT_SAYS(turbidite("").out, "turbidite [OPTIONS]");
    EXPECT_EQ(turbidite("run").code, 2);
    EXPECT_EQ(turbidite("run nowhere.yaml").code, 2);
    EXPECT_EQ(turbidite("run " + quickstart + " --frobnicate").code, 2);
    EXPECT_EQ(turbidite("report " + scratch.path().string()).code, 2);
    EXPECT_SAYS(turbidite("chekc x").err, "Did you mean check?");
    // The word behind it is taken for the case, and the case for one too many.
    const Answer option = turbidite("run --outt x dry.yaml");
    EXPECT_EQ(option.code, 2);
    EXPECT_SAYS(option.err, "turbidite run: there is no option --outt");
    EXPECT_SAYS(option.err, "Did you mean --out?");
}

// On a full disk, or with streams that a daemon has closed.
TEST_F(CommandLine, WhatCannotBePrintedChangesNoExitCodeButThatOfOutput) {
    const std::string check = program + " check ";
    EXPECT_EQ(shell(check + "nowhere.yaml 2>/dev/full").code, 2);
    EXPECT_EQ(shell(check + "nowhere.yaml 2>&-").code, 2);
    EXPECT_EQ(shell(check + "nowhere.yaml <&- >&- 2>&-").code, 2);
    const Answer lost = shell(check + quickstart + quick + " >/dev/full");
    EXPECT_EQ(lost.code, 4);
    EXPECT_SAYS(lost.err, "could not be written to standard output");
    // What a run gives is in its folder.
    EXPECT_EQ(shell(program + " run " + quickstart + quick + " --set time.end=0.1" +
                    into_run_folder() + " >/dev/full")
                  .code,
              0);
    EXPECT_EQ(record().at("status"), "done");
    // Nobody who closes it misses anything.
    EXPECT_EQ(shell(check + quickstart + quick + " >&-").code, 0);
}

// The lock of a run is the first file that it opens; why the run fails would go into it.
TEST_F(CommandLine, NoFileOfARunBecomesAClosedStream) {
    const Answer run = shell(program + " run " + quickstart + quick +
                             " --set limits.penetration=1e-9" + into_run_folder() + " 2>&-");
    EXPECT_EQ(run.code, 6);
    EXPECT_FALSE(fs::exists(run_folder() / "lock")) << text(run_folder() / "lock");
}

TEST_F(CommandLine, HelpAndVersion) {
    const Answer help = turbidite("--help");
    EXPECT_EQ(help.code, 0);
    for (const char* command : {"run", "check", "report", "compare", "keys", "test", "bench"})
        EXPECT_SAYS(help.out, std::string("\n  ") + command);
    EXPECT_SAYS(turbidite("--version").out, "turbidite ");
    EXPECT_EQ(turbidite("help").out, help.out);
    EXPECT_EQ(turbidite("help run").out, turbidite("run --help").out);
    EXPECT_SAYS(turbidite("run --help").out, "--force");
    EXPECT_SAYS(turbidite("keys").out, "| `contact.friction` |");
    EXPECT_SAYS(turbidite("keys contact").out, "\ncontact.solver");
    EXPECT_SAYS(turbidite("keys contact --markdown").out, "| `contact.friction` |");
    const auto schema = nlohmann::json::parse(turbidite("keys --schema").out);
    const auto& contact = schema.at("properties").at("contact").at("properties");
    EXPECT_EQ(contact.at("friction").at("minimum"), 0.0);
    EXPECT_EQ(contact.at("materials").at("additionalProperties").at("properties").count("friction"),
              1u);
    // Also cases in space, and keys that a case takes out.
    const auto& size = schema.at("properties").at("domain").at("properties").at("size");
    EXPECT_EQ(size.at("minItems"), 2);
    EXPECT_EQ(size.at("maxItems"), 3);
    EXPECT_EQ(contact.at("friction").at("type"), (nlohmann::json{"number", "null"}));
    const Answer wrong = turbidite("keys contcat");
    EXPECT_EQ(wrong.code, 2);
    EXPECT_SAYS(wrong.err, "Did you mean contact?");
}

TEST_F(CommandLine, ImpossibleGrainsAreRefusedAtOnce) {
    const std::string triangles = TURBIDITE_SOURCE_DIR "/configs/sedimentation-triangles.yaml";
    const Answer many = turbidite("check " + triangles + " --set grains.count=1000000000");
    EXPECT_EQ(many.code, 2);
    EXPECT_SAYS(many.err, "grains.count = 1000000000");
    EXPECT_SAYS(many.err, "no room");
    for (const char* corners : {"0", "[]"}) {
        const Answer none = turbidite("check " + triangles + " --set grains.vertices=" + corners);
        EXPECT_EQ(none.code, 2) << corners;
        EXPECT_SAYS(none.err, "--set: grains.vertices");
        EXPECT_SAYS(none.err, "A list of numbers in brackets is needed.");
    }
}

TEST_F(CommandLine, CheckWritesNothing) {
    const Answer answer = turbidite("check " + quickstart);
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "60 grains");
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()), 2);
}

TEST_F(CommandLine, EveryShippedCaseIsValid) {
    int cases = 0;
    for (const auto& file : fs::directory_iterator(TURBIDITE_SOURCE_DIR "/configs")) {
        if (file.path().extension() != ".yaml" || file.path().stem() == "expected") continue;
        ++cases;
        const Answer answer = turbidite("check " + file.path().string());
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_SAYS(answer.out, "valid");
    }
    EXPECT_GE(cases, 2);
}

TEST_F(CommandLine, TheSedimentationIsValidOnACoarserMesh) {
    const Answer answer = turbidite("check " TURBIDITE_SOURCE_DIR
                                    "/configs/sedimentation-discs.yaml"
                                    " --set fluid.cells_per_diameter=8");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "160 x 480 cells");
}

TEST_F(CommandLine, DryRunPrintsOneLineThatRunsTheJob) {
    const Answer answer = turbidite("run " + quickstart + quick + " --set time.end=0.2 --dry-run" +
                                    into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.out.rfind("mpirun ", 0), 0u) << answer.out;
    EXPECT_EQ(std::count(answer.out.begin(), answer.out.end(), '\n'), 1);
    EXPECT_TRUE(record().at("exit_code").is_null());

    const Answer pasted = shell(answer.out.substr(0, answer.out.size() - 1));
    EXPECT_EQ(pasted.code, 0) << pasted.err;
    EXPECT_EQ(record().at("windows_done"), 16);  // 0.2 / 0.0125
}

TEST_F(CommandLine, DryRunOfTheQuickstartPreparesItsFluid) {
    const Answer answer = turbidite("run " + quickstart + " --dry-run" + into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "turbidite-fluid -case " + (run_folder() / "fluid").string());
    EXPECT_SAYS(answer.out, "yade -n -x");
    EXPECT_TRUE(fs::exists(run_folder() / "fluid/constant/polyMesh/points"));
}

TEST_F(CommandLine, RunLeavesAWholeFolder) {
    with_reports();
    const Answer answer =
        turbidite("run " + quickstart + quick + " --set time.end=1 --set output.interval=0.25" +
                  into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_EQ(record().at("status"), "done");
    EXPECT_EQ(record().at("exit_code"), 0);
    EXPECT_EQ(rows_of_history(), 5);  // t = 0, 0.25, 0.5, 0.75, 1
    for (const char* file : {"case.yaml", "grains/initial.csv", "grains/grains.pvd",
                             "logs/coupler.log", "logs/grains.log", "report.html", "view.py"})
        EXPECT_TRUE(fs::exists(run_folder() / file)) << file;
    EXPECT_SAYS(text(run_folder() / "report.html"), "Status: done");
}

TEST_F(CommandLine, WetRunWithYade) {
    const Answer answer =
        turbidite("run " + quickstart + " --set time.end=0.1" + into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_EQ(record().at("ranks").size(), 2u);
    EXPECT_TRUE(fs::exists(run_folder() / "logs/fluid.log"));
    EXPECT_EQ(turbidite("report " + run_folder().string()).code, 0);
    // A signal to stop that comes while pictures are drawn, for seconds.
    const Answer stopped =
        shell("timeout --preserve-status -s INT 0.3 " TURBIDITE_PROGRAM " report " +
              run_folder().string());
    EXPECT_EQ(stopped.code, 130) << stopped.err;
}

TEST_F(CommandLine, AFolderInUseIsRefused) {
    const std::string run = std::string(TURBIDITE_PROGRAM) + " run " + quickstart + quick +
                            into_run_folder() + " --force --set time.end=";
    const Answer answer =
        shell(run + "4000 >first.log 2>&1 & job=$!; until [ -s " +
              (run_folder() / "history.csv").string() + " ]; do sleep 0.1; done; " + run +
              "1; code=$?; kill -INT $job; wait $job; exit $code");
    EXPECT_EQ(answer.code, 2) << answer.out;
    EXPECT_SAYS(answer.err, "is in use by a run that has not ended");
    EXPECT_SAYS(text(scratch.path() / "first.log"), "stopped on request");  // untouched till then
    const Answer next = shell(run + "0.1");
    EXPECT_EQ(next.code, 0) << next.err;
    EXPECT_FALSE(fs::exists(run_folder() / "lock"));
}

TEST_F(CommandLine, FieldsMayBeWrittenLessOftenThanRows) {
    const Answer answer =
        turbidite("run " + quickstart +
                  " --set time.end=0.5 --set output.interval=0.1 --set output.fields_interval=0.2" +
                  into_run_folder());
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    std::vector<std::string> times;
    for (const auto& entry : fs::directory_iterator(run_folder() / "fluid"))
        if (fs::exists(entry.path() / "U")) times.push_back(entry.path().filename());
    std::sort(times.begin(), times.end());
    EXPECT_EQ(times, (std::vector<std::string>{"0", "0.2", "0.4", "0.5"}));  // the end is written
    EXPECT_EQ(rows_of_history(), 6);
}

TEST_F(CommandLine, OccupiedFolderIsRefused) {
    scratch.write("run/precious", "x");
    const Answer answer = turbidite("run " + quickstart + quick + into_run_folder());
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "is not empty");
}

/// history.csv without the columns of wall time.
std::string physics_of(const std::string& history) {
    std::istringstream lines(history);
    std::vector<bool> kept;
    std::string result;
    for (std::string line; std::getline(lines, line); result += "\n") {
        std::istringstream cells(line + ",");
        const bool header = kept.empty();
        std::size_t column = 0;
        for (std::string cell; std::getline(cells, cell, ','); ++column) {
            if (header) kept.push_back(cell.rfind("wall_", 0) != 0);
            if (kept.at(column)) result += cell + ",";
        }
    }
    return result;
}

// The CSV has all digits, so the two runs perform the same arithmetic.
TEST_F(CommandLine, GrainsFromTheFileOfARunGiveThatRunAgain) {
    const std::string line =
        "run " + quickstart + small + " --set time.end=0.5 --set output.interval=0.1 --out ";
    const fs::path first = scratch.path() / "first", again = scratch.path() / "again";
    ASSERT_EQ(turbidite(line + first.string() + " --set random.seed=7").code, 0);
    const Answer answer = turbidite(
        line + again.string() + " --set grains.file=" + (first / "grains/initial.csv").string());
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(text(again / "grains/initial.csv"), text(first / "grains/initial.csv"));
    const std::string history = physics_of(text(first / "history.csv"));
    EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 7);  // header, t = 0, 0.1, ... 0.5
    EXPECT_EQ(physics_of(text(again / "history.csv")), history);
}

TEST_F(CommandLine, CompareWritesOnePageAndItsNumbers) {
    const std::string line = "run " + quickstart + quick + " --set output.interval=0.1 --out ";
    const fs::path one = scratch.path() / "one", two = scratch.path() / "two";
    const fs::path page = scratch.path() / "page.html";
    ASSERT_EQ(turbidite(line + one.string() + " --set time.end=0.5").code, 0);
    ASSERT_EQ(turbidite(line + two.string() + " --set time.end=0.3").code, 0);
    const Answer answer =
        turbidite("compare " + one.string() + " " + two.string() + " --out " + page.string());
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.out, page.string() + "\n");
    EXPECT_SAYS(text(page), "time.end");
    const auto numbers = nlohmann::json::parse(text(scratch.path() / "page.json"));
    const auto velocity = numbers.at("runs").at(1).at("quantities").at("mean_velocity_y");
    EXPECT_EQ(velocity.at("max"), 0.0);  // the same case, over the common time
    EXPECT_EQ(velocity.at("end"), 0.3);
    EXPECT_TRUE(fs::exists(scratch.path() / "page.csv"));
}

TEST_F(CommandLine, SeedsOfADryColumnAreAveraged) {
    // A small column of the shipped case: rows of 4, 3, ... in 4 x 6 D, with space around every
    // grain.
    const std::string line = "run " TURBIDITE_SOURCE_DIR
                             "/configs/avalanche-dry.yaml --set grains.adapter=standalone-nscd "
                             "--set grains.region=[4,6] --set domain.size=[12,8] "
                             "--set time.end=0.2 --set output.interval=0.1 --set random.seed=";
    const auto folder = [&](int seed) {
        return (scratch.path() / ("column-seed" + std::to_string(seed))).string();
    };
    for (const int seed : {1, 2}) {
        const Answer answer = turbidite(line + std::to_string(seed) + " --out " + folder(seed));
        ASSERT_EQ(answer.code, 0) << answer.err;
    }
    EXPECT_NE(text(folder(1) + "/grains/initial.csv"), text(folder(2) + "/grains/initial.csv"));
    const fs::path page = scratch.path() / "page.html";
    const std::string both = folder(1) + " " + folder(2) + " --out " + page.string();
    ASSERT_EQ(turbidite("compare " + both).code, 0);
    const auto numbers = nlohmann::json::parse(text(scratch.path() / "page.json"));
    ASSERT_EQ(numbers.at("runs").size(), 1u);
    EXPECT_EQ(numbers.at("runs").at(0).at("name"), "column");
    EXPECT_EQ(numbers.at("runs").at(0).at("seeds"), nlohmann::json({"1", "2"}));
    ASSERT_EQ(turbidite("compare --each " + both).code, 0);
    const auto apart = nlohmann::json::parse(text(scratch.path() / "page.json"));
    EXPECT_EQ(apart.at("runs").size(), 2u);
    EXPECT_GT(apart.at("mean_velocity_pairs").at(0).at("largest"), 0.0);
}

TEST_F(CommandLine, CompareRefusesWhatItCannotCompare) {
    scratch.write("run/case.yaml", "dimension: 2\n");
    scratch.write("other/note.txt", "no run");
    const std::string run = run_folder().string(), other = (scratch.path() / "other").string();
    const Answer lonely = turbidite("compare " + run);
    EXPECT_EQ(lonely.code, 2);
    EXPECT_SAYS(lonely.err, "at least two run folders");
    const Answer stranger = turbidite("compare " + run + " " + other);
    EXPECT_EQ(stranger.code, 2);
    EXPECT_SAYS(stranger.err, other + " is not a run folder");
    const Answer misnamed = turbidite("compare " + run + " " + run + " --out x.csv");
    EXPECT_EQ(misnamed.code, 2);
    EXPECT_SAYS(misnamed.err, "does not end in .html");
    EXPECT_EQ(turbidite("compare " + run + " " + run).code, 2);  // no history
}

/// A run of 160,000 windows, too long to end within a test, stopped by a signal.
class Interrupted : public CommandLine {
 protected:
    Interrupted() { with_reports(); }

    /// `before` is done just before the signal; `out` takes what is printed.
    int stop_by(
        int signal, const std::string& options, const std::string& out = "out",
        const std::function<void()>& before = [] {}) const {
        const pid_t child = fork();
        if (child == 0) {
            const std::string line = "exec " + program + " run " + quickstart + options +
                                     " --set time.end=2000 --set output.interval=1" +
                                     into_run_folder() + " >" + (scratch.path() / out).string() +
                                     " 2>&1";
            execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
            _exit(127);
        }
        for (int i = 0; i < 600 && rows_of_history() < 2; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        before();
        kill(child, signal);
        int status = 0;
        waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    long windows_done() const { return record().at("windows_done").get<long>(); }

    void expect_history_and_report_to_the_last_window() const {
        const std::string history = text(run_folder() / "history.csv");
        const auto last = history.rfind('\n', history.size() - 2) + 1;
        EXPECT_EQ(std::stol(history.substr(last)), windows_done()) << history;
        const std::string report = text(run_folder() / "report.html");
        EXPECT_SAYS(report, "Status: interrupted");
        EXPECT_EQ(report.find("Picture at"), std::string::npos) << "a picture could not be drawn";
    }
};

TEST_F(Interrupted, BySigintEndsWithTheFieldsOfTheLastWindow) {
    EXPECT_EQ(stop_by(SIGINT, small), 130) << text(scratch.path() / "out");
    EXPECT_EQ(record().at("exit_code"), 130);
    expect_history_and_report_to_the_last_window();
    double latest = 0.0;
    fs::path fields;
    for (const auto& entry : fs::directory_iterator(run_folder() / "fluid")) {
        const double time = std::atof(entry.path().filename().c_str());
        if (time > latest) latest = time, fields = entry.path();
    }
    EXPECT_NEAR(latest, 0.0125 * static_cast<double>(windows_done()), 1e-6);  // t_c = 1
    for (const char* name : {"U", "p"})  // 12 x 14 D at 4 cells per D; doubles
        EXPECT_GT(fs::file_size(fields / name), 48u * 56u * sizeof(double)) << name;
}

TEST_F(Interrupted, BySigtermEndsAfterOneMoreWindow) {
    EXPECT_EQ(stop_by(SIGTERM, quick), 143) << text(scratch.path() / "out");
    EXPECT_EQ(record().at("exit_code"), 143);
    EXPECT_GT(windows_done(), 0);
    expect_history_and_report_to_the_last_window();
}

// As Ctrl-C does in `turbidite run CASE 2>&1 | tee log`, which ends tee first.
TEST_F(Interrupted, WithoutAReaderOfItsPipeEndsInOrder) {
    const std::string pipe = scratch.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    EXPECT_EQ(stop_by(SIGINT, quick, "pipe", [reader] { close(reader); }), 130);
    EXPECT_EQ(record().at("exit_code"), 130);
    EXPECT_GT(windows_done(), 0);
    expect_history_and_report_to_the_last_window();
}

// What is right in every single window and wrong as a whole.
TEST_F(CommandLine, AStepThatIsTooLargeIsToldBeforeAndAfterTheRun) {
    const std::string check = TURBIDITE_PROGRAM " check " + quickstart;
    const Answer usual = shell(check);
    EXPECT_EQ(usual.code, 0) << usual.err;
    EXPECT_EQ(usual.out.find("warning: the Courant"), std::string::npos) << usual.out;
    const Answer large = shell(check + " --set time.step=0.5");
    EXPECT_EQ(large.code, 0) << large.err;
    EXPECT_SAYS(large.out, "warning: the Courant number will be 3.5 or more. ");
    EXPECT_SAYS(large.out, "Use time.step = 0.2 or less.");
    const Answer run = shell(TURBIDITE_PROGRAM " run " + quickstart +
                             " --set time.step=0.5 --set time.end=10 --set "
                             "grains.adapter=standalone-nscd --out run");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_SAYS(run.out, "turbidite: warning: the Courant number is ");
    EXPECT_SAYS(run.out, "turbidite: warning: the Courant number was up to ");
    EXPECT_EQ(record().at("warnings").at(0).at("about"), "courant");
}

TEST_F(CommandLine, RanksBeyondTheCoresAreForecastAsSlower) {
    const auto cores = std::to_string(sysconf(_SC_NPROCESSORS_ONLN));
    const auto more = std::to_string(8 * sysconf(_SC_NPROCESSORS_ONLN));
    const std::string check = TURBIDITE_PROGRAM " check " + quickstart + " --set fluid.ranks=";
    const Answer enough = shell(check + cores), many = shell(check + more);
    EXPECT_EQ(enough.out.find("warning: "), std::string::npos) << enough.out;
    EXPECT_EQ(many.code, 0) << many.err;
    EXPECT_SAYS(many.out, "warning: fluid.ranks = " + more + " on " + cores + " cores: ");
    EXPECT_SAYS(many.out, "times as long as with " + cores);
}

// A terminal that can only print: TERM=dumb, as in editors and logs of terminals.
TEST_F(CommandLine, ADumbTerminalGetsPlainLines) {
    scratch.write("terminal.py",
                  "import os, pty, sys\n"
                  "sys.exit(os.waitstatus_to_exitcode(pty.spawn(sys.argv[1:])))\n");
    scratch.write("fall.yaml",
                  "domain: {size: [8, 8]}\n"
                  "grains: {adapter: standalone-nscd, count: 3}\n"
                  "fluid: {enabled: false}\n"
                  "time: {step: 0.01, end: 1}\n"
                  "output: {interval: 0.5}\n");
    const auto on_terminal = [&](const std::string& kind) {
        return shell("TERM=" + kind +
                     " timeout 60 /usr/bin/python3 terminal.py " TURBIDITE_PROGRAM
                     " run fall.yaml --force --out run");
    };
    const Answer dumb = on_terminal("dumb"), able = on_terminal("xterm");
    EXPECT_EQ(dumb.code, 0) << dumb.out << dumb.err;
    EXPECT_SAYS(dumb.out, "0.5/1 t_c  fall ");
    EXPECT_SAYS(dumb.out, "1.0/1 t_c  fall ");
    EXPECT_EQ(dumb.out.find('\033'), std::string::npos) << dumb.out;
    EXPECT_EQ(able.code, 0) << able.out << able.err;
    EXPECT_SAYS(able.out, "\r\033[K1.0/1 t_c  fall ");
}

}  // namespace
}  // namespace turbidite
