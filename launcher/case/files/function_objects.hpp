// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A file with OpenFOAM's function objects (fluid.functions): what stands between the braces of
// `functions` in system/controlDict. OpenFOAM reads the dictionary; here only that is read which
// can be said before a run: whether its braces and quotes are closed, which files it includes, and
// what in it has to be compiled.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/keys/case_error.hpp"

namespace turbidite {

/// Something that OpenFOAM compiles when it reads the file.
struct CompiledPart {
    std::string source;  ///< name of the file
    int line = 0;
    std::string what;  ///< "type coded", "#calc", "#codeStream"
};

struct FunctionObjectsFile {
    std::string text;                ///< with the files that it includes by relative paths
    std::vector<std::string> names;  ///< of the dictionaries in it
    bool from_elsewhere = false;     ///< directives bring in more
    std::vector<CompiledPart> compiled;
    CaseProblems problems;
};

/// Files that `#include`, `#includeIfPresent` and `#sinclude` name by a path relative to the file
/// they stand in become part of the text; other directives and paths stay as they are.
FunctionObjectsFile read_function_objects(const std::filesystem::path& file);

}  // namespace turbidite
