// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite gallery [NAME]...: plays shipped cases and compares them with the numbers that
// configs/expected.yaml expects of them. This file reads that one and starts the script that does.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/files/yaml_tree.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/hand_over.hpp"
#include "launcher/job/programs.hpp"
#include "launcher/job/standard_input.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

struct GalleryOptions {
    std::vector<std::string> names;
    std::string expected;
    std::string out = "runs/gallery";
    bool quick = false;
    bool record = false;
    bool judge = false;
    bool json = false;
};

/// Words in quotes stay words: a commit may consist of digits.
nlohmann::ordered_json scalar(const YAML::Node& node) {
    bool truth = false;
    double number = 0.0;
    if (node.Tag() == "!") return node.Scalar();
    if (YAML::convert<bool>::decode(node, truth)) return truth;
    if (YAML::convert<double>::decode(node, number)) return number;
    return node.Scalar();
}

nlohmann::ordered_json as_json(const YAML::Node& node) {
    if (node.IsNull()) return nullptr;
    if (node.IsScalar()) return scalar(node);
    auto result = node.IsMap() ? nlohmann::ordered_json::object() : nlohmann::ordered_json::array();
    for (const auto& item : node)
        if (node.IsMap())
            result[item.first.Scalar()] = as_json(item.second);
        else
            result.push_back(as_json(item));
    return result;
}

nlohmann::ordered_json read_expected(const fs::path& file) {
    std::ifstream in(file);
    if (!in)
        throw Failure(ExitCode::bad_input,
                      fmt::format("{} cannot be opened\n  It holds the expected numbers of cases. "
                                  "Exit code 2.",
                                  file.string()));
    try {
        return as_json(yaml_tree({std::istreambuf_iterator<char>(in), {}}));
    } catch (const YamlFault& fault) {
        throw Failure(ExitCode::bad_input,
                      fmt::format("{}:{}: {}\n  {} Exit code 2.", file.string(), fault.line,
                                  fault.fault, fault.remedy));
    }
}

[[noreturn]] int gallery(const GalleryOptions& options) {
    const Programs programs = find_programs();
    const fs::path expected =
        options.expected.empty() ? programs.expected() : fs::absolute(options.expected);
    const nlohmann::ordered_json numbers = read_expected(expected);
    std::vector<std::string> line{programs.python(),  "-B",
                                  programs.gallery(), programs.folder / "turbidite",
                                  programs.configs(), expected};
    line.insert(line.end(), {"--out", options.out});
    if (options.quick) line.push_back("--quick");
    if (options.record) line.push_back("--record");
    if (options.judge) line.push_back("--judge");
    if (options.json) line.push_back("--json");
    line.insert(line.end(), options.names.begin(), options.names.end());
    give_standard_input(numbers.dump());
    hand_over(std::move(line));
}

}  // namespace

CommandAction declare_gallery(CLI::App& app) {
    const auto options = std::make_shared<GalleryOptions>();
    app.add_option("NAME", options->names,
                   "cases or studies to play; without any all are listed, with what is recorded");
    app.add_flag("--quick", options->quick, "their short forms, which have numbers of their own");
    app.add_option(
           "--out", options->out,
           "where the runs go: DIR/NAME; a case there is replaced, a study goes on with the "
           "runs of the same commit")
        ->type_name("DIR")
        ->capture_default_str();
    app.add_flag("--record", options->record,
                 "if all numbers hold, write commit, date, time and memory into the file of "
                 "expected numbers");
    app.add_flag("--judge", options->judge,
                 "compare what `gallery` has played into --out before, without playing it again");
    app.add_flag("--json", options->json, "print the list for scripts");
    app.add_option("--expected", options->expected,
                   "another file of expected numbers than configs/expected.yaml")
        ->type_name("FILE");
    return [options]() -> int { gallery(*options); };
}

}  // namespace turbidite
