// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Reads a document of YAML that anybody may have written.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace turbidite {

/// Why a document is refused.
struct YamlFault {
    int line = 0;  ///< 1-based; 0: unknown
    std::string fault, remedy;
};

/// The tree of a document, which is finite and small: every alias counts as what it stands for.
/// Throws YamlFault for what is not YAML, for an alias inside itself or too many values, and for
/// values that are not UTF-8 or contain control characters.
YAML::Node yaml_tree(const std::string& text);

/// Of an error of the parser, or of a look-up in the tree.
YamlFault yaml_fault(const YAML::Exception& error);

}  // namespace turbidite
