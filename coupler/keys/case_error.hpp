// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A problem with a case, in a form a user can act on: place, key, value, allowed values, remedy.
// Problems are collected and shown together; nothing starts while there is one.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

struct CaseProblem {
    std::string source;   ///< "quickstart.yaml", "--set", "grains.csv"
    int line = 0;         ///< 1-based; 0 when there is none
    std::string key;      ///< "contact.friction"; may be empty (syntax errors)
    std::string value;    ///< as written; shown as `key = value`
    std::string fault;    ///< replaces `= value`: "is unknown", "is missing", "is given twice"
    std::string allowed;  ///< a sentence
    std::string remedy;   ///< a sentence
};

/// What is wrong with a case; empty if it may start.
using CaseProblems = std::vector<CaseProblem>;
void append(CaseProblems& problems, CaseProblems more);

/// A problem with a place in a file rather than with a key.
CaseProblem problem_at(const std::string& source, int line, const std::string& fault,
                       const std::string& allowed, const std::string& remedy);

/// The text shown on stderr; ends with "N errors, nothing was started. Exit code 2."
std::string format_problems(const CaseProblems& problems);

/// Exit code 2 with every problem found; what() is format_problems.
class CaseRefused : public Failure {
 public:
    explicit CaseRefused(CaseProblems problems);
    const CaseProblems& problems() const { return problems_; }

 private:
    CaseProblems problems_;
};

}  // namespace turbidite
