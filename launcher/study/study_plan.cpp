// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/study/study_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "launcher/case/files/case_entries.hpp"
#include "launcher/case/forecast/disk_cost.hpp"
#include "launcher/case/forecast/remarks.hpp"
#include "launcher/case/forecast/run_cost.hpp"
#include "launcher/case/grains/packing/pouring.hpp"

namespace turbidite {
namespace {

/// As part of a folder's name: OpenFOAM and shells take letters, digits, point, plus and minus.
std::string file_name(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool plain =
            std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '+' || c == '-';
        if (plain)
            result += c;
        else if (!result.empty() && result.back() != '_')
            result += '_';
    }
    while (!result.empty() && result.back() == '_') result.pop_back();
    return result;
}

std::string without_digits(std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isdigit(c) || c == '.'; });
    return text;
}

std::string last_word(const std::string& key) {
    const auto point = key.rfind('.');
    return point == std::string::npos ? key : key.substr(point + 1);
}

/// Its last word, unless another axis ends alike.
std::string short_name(const SweepAxis& axis, const StudyPart& part) {
    const auto alike = [&](const SweepAxis& other) {
        return last_word(other.key) == last_word(axis.key);
    };
    const bool unique = std::count_if(part.axes.begin(), part.axes.end(), alike) == 1;
    return unique ? last_word(axis.key) : axis.key;
}

void append(std::string& name, const std::string& word) {
    name += (name.empty() ? "" : "-") + file_name(word);
}

/// The runs so far, each once per value of the axis.
std::vector<PlannedRun> along(const std::vector<PlannedRun>& runs, const SweepAxis& axis,
                              const StudyPart& part) {
    const bool named = axis.key == "variant";
    std::vector<PlannedRun> result;
    for (const PlannedRun& run : runs)
        for (const SweepPoint& point : axis.points) {
            PlannedRun next = run;
            if (!named) append(next.name, short_name(axis, part));
            append(next.name, point.text);
            next.overrides.insert(next.overrides.end(), point.overrides.begin(),
                                  point.overrides.end());
            next.values.emplace_back(axis.key, point.text);
            result.push_back(next);
        }
    return result;
}

/// What the command line asks for.
struct Asked {
    std::vector<std::string> overrides;  ///< key=value
    bool quick;
};

/// key=value of an entry. A text that would be read as something else stands in quotes.
std::string override_of(const CaseEntry& entry) {
    const std::string plain = entry.key + "=" + (entry.is_null ? "~" : entry.value);
    if (entry.is_null || entry.is_list) return plain;
    const CaseEntries again = entries_of_override(plain);
    const bool same = again.problems.empty() && again.entries.size() == 1 &&
                      again.entries[0].value == entry.value && !again.entries[0].is_list;
    return same ? plain : quoted_override(entry.key, entry.value);
}

/// --set takes groups, `contact={friction: 0.5}`; what is not key=value is refused with the cases.
std::vector<std::string> with_flat_keys(const std::vector<std::string>& overrides) {
    std::vector<std::string> result;
    for (const std::string& text : overrides)
        for (const CaseEntry& entry : entries_of_override(text).entries)
            result.push_back(override_of(entry));
    return result;
}

/// The value as names and tables have it: without quotes.
std::string value_of(const std::string& override_) {
    const CaseEntries read = entries_of_override(override_);
    const bool quoted = override_.back() == '"' && read.entries.size() == 1;
    return quoted ? read.entries[0].value : override_.substr(override_.find('=') + 1);
}

/// The axis, or the one value that `full`, `quick` or --set gives to its key; of several the last.
SweepAxis at_level(const SweepAxis& axis, const std::vector<std::string>& level) {
    SweepAxis result = axis;
    for (const std::string& override_ : level)
        if (override_.rfind(axis.key + "=", 0) == 0)
            result = {axis.key, {{value_of(override_), {override_}}}};
    return result;
}

/// Keys of every run of the part beside `set`: those of `full` or `quick`, then those of --set.
std::vector<std::string> level_of(const StudyPart& part, const Asked& asked) {
    std::vector<std::string> level = asked.quick ? part.quick : part.full;
    level.insert(level.end(), asked.overrides.begin(), asked.overrides.end());
    return level;
}

std::vector<PlannedRun> runs_of(const StudyPart& part, const Asked& asked) {
    std::vector<PlannedRun> runs = {{.part = part.name,
                                     .name = {},
                                     .case_file = part.case_file,
                                     .overrides = part.overrides,
                                     .values = {}}};
    const std::vector<std::string>& own = asked.quick ? part.quick : part.full;
    runs[0].overrides.insert(runs[0].overrides.end(), own.begin(), own.end());
    const std::vector<std::string> level = level_of(part, asked);
    for (const SweepAxis& axis : part.axes) runs = along(runs, at_level(axis, level), part);
    if (part.axes.empty()) runs[0].name = part.case_file.stem().string();
    return runs;
}

/// A value of a sweep is none of --set, whatever the reader of cases takes it for.
CaseProblem in_run(CaseProblem problem, const PlannedRun& run) {
    if (problem.source == "--set") problem.source = "run " + run.path();
    return problem;
}

std::string text_of(const CaseProblem& p) {
    return fmt::format("{} {} {} {} {}", p.line, p.key, p.value, p.fault, p.allowed);
}

/// Names of cases and variants may have nothing that a folder can be called after.
void check_name(const PlannedRun& run, std::vector<CaseProblem>& problems) {
    if (is_folder_name(run.name)) return;
    problems.push_back(
        problem_at("part " + run.part, 0, "has a run called \"" + run.name + "\"",
                   "It becomes a folder: letters, digits and . _ + -, with no point first.",
                   "Choose other names of variants, or of the case file."));
}

/// Every run is resolved before the first one starts.
constexpr double most_runs = 10000;

double number_of_runs(const StudyPart& part, const Asked& asked) {
    double runs = 1.0;
    for (const SweepAxis& axis : part.axes)
        runs *= static_cast<double>(at_level(axis, level_of(part, asked)).points.size());
    return runs;
}

void check_number(const Study& study, const Asked& asked) {
    double runs = 0.0;
    for (const StudyPart& part : study.parts) runs += number_of_runs(part, asked);
    if (runs <= most_runs) return;
    throw CaseRefused({problem_at(study.name, 0, fmt::format("has {:g} runs", runs),
                                  fmt::format("A study has {} runs at most.", most_runs),
                                  "Sweep fewer values together, or write several studies.")});
}

void find_equal_names(const std::string& study, const std::vector<PlannedRun>& runs,
                      std::vector<CaseProblem>& problems) {
    std::set<std::string> seen;
    for (const PlannedRun& run : runs)
        if (!seen.insert(run.path()).second)
            problems.push_back(problem_at(study, 0, "has two runs " + run.path(),
                                          "Runs differ in a swept value, or in the name of their "
                                          "variant, in which all but letters, digits and . + - are "
                                          "written as _.",
                                          "Remove the value that is listed twice, or rename a "
                                          "variant."));
}

void require_quick(const Study& study, std::vector<CaseProblem>& problems) {
    const auto has = [](const StudyPart& part) { return !part.quick.empty(); };
    if (std::any_of(study.parts.begin(), study.parts.end(), has)) return;
    problems.push_back(problem_at(study.name, 0, "has no quick form",
                                  "Keys of --quick stand below quick in its parts.",
                                  "Leave out --quick, or add for example quick: "
                                  "{fluid.cells_per_diameter: 8}."));
}

}  // namespace

std::vector<PlannedRun> plan_study(const Study& study, const std::vector<std::string>& overrides,
                                   bool quick) {
    const Asked asked{with_flat_keys(overrides), quick};
    check_number(study, asked);
    std::vector<CaseProblem> problems = study.problems;
    if (quick) require_quick(study, problems);
    std::vector<PlannedRun> plan;
    for (const StudyPart& part : study.parts)
        if (!part.case_file.empty())
            for (PlannedRun& run : runs_of(part, asked)) plan.push_back(std::move(run));
    find_equal_names(study.name, plan, problems);
    for (const PlannedRun& run : plan) check_name(run, problems);
    std::set<std::string> told;
    for (PlannedRun& run : plan) {
        run.overrides.insert(run.overrides.end(), overrides.begin(), overrides.end());
        try {
            const ResolvedCase resolved = run.resolve();
            run.hash = resolved.settings.text("run.hash");
            run.poured = is_poured(resolved.settings);
            run.yaml = resolved.yaml;
            run.given = resolved.given;
            run.remarks = remarks_of(resolved);
            run.seconds = predicted_seconds(resolved);
            run.disk = predicted_disk(resolved);
        } catch (const CaseRefused& refused) {
            for (const CaseProblem& problem : refused.problems())
                if (told.insert(text_of(problem)).second) problems.push_back(in_run(problem, run));
        }
    }
    if (!problems.empty()) throw CaseRefused(std::move(problems));
    return plan;
}

double predicted_disk(const std::vector<const PlannedRun*>& runs) {
    double sum = 0.0;
    for (const PlannedRun* run : runs) sum += run->disk;
    return sum;
}

std::string remarks_text(const std::vector<PlannedRun>& plan) {
    struct Told {
        std::string kind, text, run;
        int runs;
    };
    std::vector<Told> all;
    for (const PlannedRun& run : plan)
        for (const std::string& remark : run.remarks) {
            const std::string kind = without_digits(remark);
            const auto at = std::find_if(all.begin(), all.end(),
                                         [&](const Told& told) { return told.kind == kind; });
            if (at != all.end())
                ++at->runs;
            else
                all.push_back({kind, remark, run.path(), 1});
        }
    std::string text;
    for (const Told& told : all)
        text += fmt::format("  {}\n    ({} of {} runs; the first is {})\n", told.text, told.runs,
                            plan.size(), told.run);
    return text;
}

std::string forecast_text(const std::vector<const PlannedRun*>& runs) {
    double seconds = 0.0;
    for (const PlannedRun* run : runs) seconds += run->seconds;
    return "roughly " + rough_time(seconds) + ", " + rough_size(predicted_disk(runs)) + " of files";
}

}  // namespace turbidite
