// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/files/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <sstream>

#include "coupler/protocol/received.hpp"

namespace turbidite {
namespace {

constexpr int most_values = 20000, deepest = 100;

int line_of(const YAML::Node& node) {
    return node.Mark().line + 1;
}

/// Goes through a tree as one does who follows every alias. A few lines of aliases of aliases stand
/// for more values than there is memory, and one inside itself for infinitely many.
class Walk {
 public:
    void through(const YAML::Node& node, int depth = 0) {
        count(node, depth);
        if (node.IsScalar()) check_text(node);
        for (const auto& item : node)
            if (node.IsMap()) {
                check_key(item.first);
                through(item.first, depth + 1);
                through(item.second, depth + 1);
            } else {
                through(item, depth + 1);
            }
    }

 private:
    void count(const YAML::Node& node, int depth) {
        if (depth > deepest)
            throw YamlFault{line_of(node),
                            fmt::format("is nested more than {} levels deep", deepest),
                            "Use fewer levels, and no alias inside its own anchor."};
        if (++values_ > most_values)
            throw YamlFault{line_of(node),
                            fmt::format("stands for more than {} values", most_values),
                            "Write fewer, in particular fewer aliases of aliases (*name)."};
    }

    /// YAML 1.2 has no merge keys, and yaml-cpp does not follow them.
    static void check_key(const YAML::Node& key) {
        if (key.IsScalar() && key.Scalar() == "<<")
            throw YamlFault{
                line_of(key), "has the merge key <<, which is not followed",
                "Write these keys out, or let an alias (*name) stand for all of a block."};
    }

    static void check_text(const YAML::Node& node) {
        if (node.Scalar() != received_text(node.Scalar()))
            throw YamlFault{line_of(node),
                            fmt::format("has the value \"{}\", which is not UTF-8 or has control "
                                        "characters",
                                        received_line(node.Scalar())),
                            "Save the file as UTF-8, or remove them."};
    }

    int values_ = 0;
};

/// Where the second document of a text begins.
class Documents : public YAML::EventHandler {
 public:
    void OnDocumentStart(const YAML::Mark& mark) override { line = mark.line + 1; }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
    void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
    void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  const std::string&) override {}
    void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {}
    void OnMapEnd() override {}

    int line = 0;
};

/// 0 if there is none. All documents are not to be read: of a stray comma the parser makes empty
/// ones without end.
int line_of_second_document(const std::string& text) {
    std::istringstream input(text);
    YAML::Parser parser(input);
    Documents documents;
    return parser.HandleNextDocument(documents) && parser.HandleNextDocument(documents)
               ? documents.line
               : 0;
}

/// The first line that is indented with a tab, 0 if there is none.
int tab_line(const std::string& text) {
    std::istringstream lines(text);
    int number = 1;
    for (std::string line; std::getline(lines, line); ++number)
        if (line.substr(0, line.find_first_not_of(" \t")).find('\t') != std::string::npos)
            return number;
    return 0;
}

}  // namespace

YAML::Node yaml_tree(const std::string& text) {
    try {
        if (const int line = line_of_second_document(text); line > 0)
            throw YamlFault{line, "begins a second document, which is not read",
                            "Remove it, or write it to a file of its own."};
        const YAML::Node root = YAML::Load(text);
        Walk().through(root);
        return root;
    } catch (const YAML::Exception& error) {
        // The parser takes a tab for a part of the key, and names another fault.
        if (const int line = tab_line(text); line > 0)
            throw YamlFault{line, "is indented with a tab", "YAML wants spaces: replace the tab."};
        throw yaml_fault(error);
    }
}

YamlFault yaml_fault(const YAML::Exception& error) {
    return {error.mark.line + 1, "is not YAML: " + error.msg,
            "Correct this line; indentation counts."};
}

}  // namespace turbidite
