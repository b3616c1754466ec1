// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/case_error.hpp"

#include <fmt/format.h>

#include <utility>

#include "coupler/protocol/received.hpp"

namespace turbidite {
namespace {

std::string place(const CaseProblem& problem) {
    if (problem.line > 0) return fmt::format("{} line {}: ", problem.source, problem.line);
    return problem.source.empty() ? "" : problem.source + ": ";
}

std::string statement(const CaseProblem& problem) {
    if (problem.key.empty()) return problem.fault;
    if (!problem.fault.empty()) return problem.key + " " + problem.fault;
    return problem.key + " = " + problem.value;
}

std::string advice(const CaseProblem& problem) {
    const bool both = !problem.allowed.empty() && !problem.remedy.empty();
    return problem.allowed + (both ? " " : "") + problem.remedy;
}

}  // namespace

void append(CaseProblems& problems, CaseProblems more) {
    for (CaseProblem& problem : more) problems.push_back(std::move(problem));
}

CaseProblem problem_at(const std::string& source, int line, const std::string& fault,
                       const std::string& allowed, const std::string& remedy) {
    return {.source = source,
            .line = line,
            .key = {},
            .value = {},
            .fault = fault,
            .allowed = allowed,
            .remedy = remedy};
}

std::string format_problems(const CaseProblems& problems) {
    std::string text;
    for (const CaseProblem& problem : problems)
        text += fmt::format("{}{}\n  {}\n", place(problem), statement(problem), advice(problem));
    // Values stand in it as they were written.
    return received_text(text) + fmt::format("{} error{}, nothing was started. Exit code 2.",
                                             problems.size(), problems.size() == 1 ? "" : "s");
}

CaseRefused::CaseRefused(CaseProblems problems)
    : Failure(ExitCode::bad_input, format_problems(problems)), problems_(std::move(problems)) {}

}  // namespace turbidite
