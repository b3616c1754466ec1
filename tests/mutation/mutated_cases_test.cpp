// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A case that was mutated at random is refused with code 2, or is valid and then means in its run
// folder what it meant when it was checked; a study is refused, or has runs whose folders lie in
// its own. They never end in another way, in a crash, or not at all. TURBIDITE_MUTATIONS=100000
// plays as many, TURBIDITE_FIRST_MUTATION=N begins with number N; a failure prints case and number.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "coupler/protocol/files/run_files.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/study/study_plan.hpp"
#include "tests/mutation/mutate.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

using mutation::CaseText;

constexpr long usual_mutations = 1000, per_process = 250;
constexpr unsigned longest = 30;  // for one case [s]

const char* const grains_csv =
    "id,x,y,radius,shape,angle,vx,vy,spin,density,material,motion\n"
    "1,2,2,0.5,disc,0,0,0,0,1.5,default,free\n2,4,2,0.5,disc,0,0.1,0,0,1.5,default,free\n"
    "3,6,2,0.75,triangle,0.4,0,0,0,1.2,steel,free\n4,2,5,0.5,disc,0,0,0,0,1.5,default,m\n"
    "5,4,5,0.5,disc,0,0,0,0,1.5,default,fixed\n";
const char* const walls_csv =
    "id,x1,y1,x2,y2,thickness,vx,vy,spin,px,py,friction,motion\n"
    "1,1,7,5,7.5,0.5,0,0,0,3,7,0.3,\n2,6,6,7,7,0.5,0,0,0,6,6,0.2,m\n";
const char* const every_kind_of_key = R"(
domain:
  size: [8, 10]
  walls_file: walls.csv
  right_motion: m
  motions: {m: {kind: harmonic, amplitude: [0, 0.1], period: 2}}
grains: {adapter: standalone-nscd, file: grains.csv, density_ratio: 1.5}
fluid: {reynolds: 36, cells_per_diameter: 8, splitting: explicit-multiplier}
contact: {friction: 0.3, materials: {steel: {friction: 0.1}}}
time: {step: 0.01, end: 1}
output: {interval: 0.1, probes: [1, 1, 2, 2]}
)";

const char* const small_case =
    "domain: {size: [6, 6]}\ngrains: {adapter: standalone-nscd, generator: lattice, region: [3, "
    "2]}\n"
    "fluid: {enabled: false}\ntime: {step: 0.01, end: 0.5}\noutput: {interval: 0.1}\n";
const char* const every_kind_of_study = R"(
out: runs/mutated
parts:
  column:
    case: case.yaml
    set: {time.end: 0.2, contact: {friction: 0.4}}
    full: {output.interval: 0.05}
    quick: {output.interval: 0.1, random.seed: 1}
    variants: {nscd: {}, md: {grains.adapter: standalone-md}}
    sweep: {grains.compacity: [0.8, 0.9], random.seed: [1]}
  alone: {case: case.yaml}
)";

std::vector<CaseText> starting_cases() {
    std::vector<CaseText> cases(4, CaseText{every_kind_of_key, grains_csv, walls_csv, {}});
    cases.resize(7, {small_case, grains_csv, walls_csv, {}, every_kind_of_study});
    for (const auto& file : std::filesystem::directory_iterator(TURBIDITE_SOURCE_DIR "/configs")) {
        std::ifstream in(file.path());
        std::stringstream text;
        text << in.rdbuf();
        // To place tens of thousands of grains takes seconds.
        static const std::regex many("count: [0-9]{5,}");
        const std::string yaml = std::regex_replace(text.str(), many, "count: 300");
        if (file.path().extension() == ".yaml" && yaml.find("domain:") != std::string::npos)
            cases.push_back({yaml, grains_csv, walls_csv, {}});
    }
    return cases;
}

std::string fault_of_study(const CaseText& text, const ScratchFolder& folder, long& valid) {
    const Study study = read_study(folder.write("study.yaml", text.study));
    const std::vector<PlannedRun> plan = plan_study(study, text.set);
    ++valid;
    for (const PlannedRun& run : plan) {
        const std::filesystem::path path = run.path(), plain = path.lexically_normal();
        if (path != plain || plain.is_absolute() || *plain.begin() == ".." || run.name.empty() ||
            std::distance(plain.begin(), plain.end()) != 2)
            return "a run goes to " + run.path();
    }
    return "";
}

/// What is wrong with how a case ended; empty if nothing is.
std::string fault_of(const CaseText& text, const ScratchFolder& folder, long& valid) {
    folder.write("grains.csv", text.grains);
    folder.write("walls.csv", text.walls);
    const auto file = folder.write("case.yaml", text.yaml);
    try {
        if (!text.study.empty()) return fault_of_study(text, folder, valid);
        const ResolvedCase checked = load_case(file, text.set);
        ++valid;
        folder.write("run/case.yaml", checked.yaml);
        folder.write("run/grains/initial.csv", checked.grains_csv);
        if (!checked.walls_csv.empty()) folder.write("run/grains/walls.csv", checked.walls_csv);
        if (!checked.script.empty()) return "";  // its file is not written here
        if (load_run_folder(folder.path() / "run").settings.entries() != checked.settings.entries())
            return "the run folder means something else";
    } catch (const Failure& refused) {
        if (refused.code() != ExitCode::bad_input)
            return fmt::format("code {}: {}", static_cast<int>(refused.code()), refused.what());
        if (std::string(refused.what()).empty()) return "refused without a word";
    } catch (const std::exception& error) {
        return std::string("an exception: ") + error.what();
    }
    return "";
}

/// Not under the address sanitizer, which reserves terabytes of addresses.
void limit_memory() {
#ifndef __SANITIZE_ADDRESS__
    constexpr rlim_t most = 3UL * 1024 * 1024 * 1024;  // [bytes]
    const rlimit memory{most, most};
    setrlimit(RLIMIT_AS, &memory);
#endif
}

/// Plays mutations in this process, which ends; the one in work is in the file `last`.
[[noreturn]] void play(long first, long count, const std::vector<CaseText>& cases,
                       const std::filesystem::path& last) {
    limit_memory();
    const ScratchFolder folder;
    std::filesystem::create_directories(folder.path() / "run" / "grains");
    long valid = 0, faults = 0;
    for (long n = first; n < first + count; ++n) {
        mutation::Random random(static_cast<std::uint64_t>(n));
        const CaseText text = mutated(cases[static_cast<std::size_t>(n) % cases.size()], random);
        std::ofstream(last) << "mutation " << n << "\n" << text.all();
        alarm(longest);
        const std::string fault = fault_of(text, folder, valid);
        if (!fault.empty() && ++faults <= 5) {
            std::fprintf(stderr, "mutation %ld: %s\n%s\n", n, fault.c_str(), text.all().c_str());
        }
    }
    alarm(0);
    std::ofstream(last) << valid << "\n";
    std::filesystem::remove_all(folder.path());
    _exit(faults > 0 ? 1 : 0);
}

long number_from(const char* variable, long otherwise) {
    const char* const given = std::getenv(variable);
    return given ? std::atol(given) : otherwise;
}

TEST(MutatedCases, AreRefusedOrMeanWhatTheySay) {
    const long mutations = number_from("TURBIDITE_MUTATIONS", usual_mutations);
    const long start = number_from("TURBIDITE_FIRST_MUTATION", 0);
    const std::vector<CaseText> cases = starting_cases();
    ASSERT_GT(cases.size(), 8u);
    const ScratchFolder folder;
    const auto last = folder.path() / "last.txt";
    long valid = 0;
    for (long done = 0; done < mutations; done += per_process) {
        const pid_t child = fork();
        if (child == 0) play(start + done, std::min(per_process, mutations - done), cases, last);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        std::ifstream in(last);
        std::stringstream text;
        text << in.rdbuf();
        EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status) << " in " << text.str();
        EXPECT_EQ(WEXITSTATUS(status), 0);
        valid += std::atol(text.str().c_str());
    }
    std::printf("%ld mutations, %ld of them valid\n", mutations, valid);
    EXPECT_GT(valid, mutations / 50);
    EXPECT_LT(valid, mutations / 2);
}

}  // namespace
}  // namespace turbidite
