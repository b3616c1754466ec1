// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The messages with which cases are refused, and files beside them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "launcher/case/case_file.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

/// Cases that consist of a fixed beginning and additions of the test.
class CaseTest : public ::testing::Test {
 protected:
    explicit CaseTest(std::string beginning) : beginning_(std::move(beginning)) {}

    ScratchFolder folder;

    ResolvedCase load(const std::string& more = "",
                      const std::vector<std::string>& set = {}) const {
        return load_case(folder.write("box.yaml", beginning_ + more), set);
    }

    /// The message; empty if the case is accepted.
    std::string refusal(const std::string& more, const std::vector<std::string>& set = {}) const {
        try {
            load(more, set);
        } catch (const CaseRefused& refused) {
            EXPECT_EQ(refused.code(), ExitCode::bad_input);
            return refused.what();
        }
        return "";
    }

    /// The same with a grains file g.csv with this content.
    std::string refusal_of_grains(const std::string& csv) const {
        folder.write("g.csv", csv);
        return refusal("", {"grains.file=g.csv"});
    }

 private:
    std::string beginning_;
};

}  // namespace turbidite
