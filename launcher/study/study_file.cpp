// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "coupler/keys/case_error.hpp"
#include "coupler/keys/nearest_name.hpp"
#include "launcher/case/files/case_entries.hpp"
#include "launcher/case/files/file_names.hpp"
#include "launcher/case/files/yaml_tree.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> part_keys = {"case", "set", "full", "quick", "sweep", "variants"};

/// Sets of figures, launcher/report/NAME.
const std::vector<std::string> figure_sets = {"paper"};

/// What is wrong with a study file, collected.
class Complaints {
 public:
    explicit Complaints(std::string source) : source_(std::move(source)) {}

    void add(const YAML::Node& node, const std::string& fault, const std::string& allowed,
             const std::string& remedy) {
        problems_.push_back(problem_at(source_, node.Mark().line + 1, fault, allowed, remedy));
    }

    std::vector<CaseProblem> all() const { return problems_; }

 private:
    std::string source_;
    std::vector<CaseProblem> problems_;
};

std::string value_text(const YAML::Node& node) {
    if (node.IsScalar()) return node.Scalar();
    if (node.IsNull()) return "~";
    // On one line: --set takes no lists in block form. A node keeps the form it was written in.
    YAML::Node flow = YAML::Clone(node);
    flow.SetStyle(YAML::EmitterStyle::Flow);
    YAML::Emitter text;
    text << flow;
    return text.c_str();
}

/// An override is read as YAML again: what stands in quotes, by this tag of yaml_tree, keeps them.
std::string override_of(const std::string& key, const YAML::Node& node) {
    if (node.IsScalar() && node.Tag() == "!") return quoted_override(key, node.Scalar());
    return key + "=" + value_text(node);
}

/// "group.key=value" of every leaf; groups may be nested or written with dots.
void flatten(const std::string& prefix, const YAML::Node& node, std::vector<std::string>& result) {
    for (const auto& item : node) {
        const std::string key = prefix + item.first.Scalar();
        if (item.second.IsMap())
            flatten(key + ".", item.second, result);
        else
            result.push_back(override_of(key, item.second));
    }
}

std::string key_of(const std::string& override_) {
    return override_.substr(0, override_.find('='));
}

/// A key may be given in a group and with dots: the last one would count.
void refuse_repeated(const YAML::Node& node, const std::string& what,
                     const std::vector<std::string>& overrides, Complaints& complaints) {
    std::set<std::string> seen;
    for (const std::string& one : overrides)
        if (!seen.insert(key_of(one)).second)
            complaints.add(node, fmt::format("{} gives {} twice", what, key_of(one)),
                           "A key has one value.", "Keep one of the two.");
}

std::vector<std::string> overrides_of(const YAML::Node& node, const std::string& what,
                                      Complaints& complaints) {
    std::vector<std::string> result;
    if (!node.IsDefined()) return result;
    if (node.IsMap()) {
        flatten("", node, result);
        refuse_repeated(node, what, result, complaints);
    } else
        complaints.add(node, what + " contains no keys", "It is a map `key: value`.",
                       "Write for example set: {time.end: 20}.");
    return result;
}

/// Keys may be nested or written with dots: the last list would count, and names say both.
void refuse_swept_before(const YAML::Node& node, const std::string& key, const StudyPart& part,
                         Complaints& complaints) {
    for (const SweepAxis& axis : part.axes)
        if (axis.key == key)
            complaints.add(node, "sweep gives " + key + " twice", "A key has one list of values.",
                           "Merge the two.");
}

std::optional<double> number_in(const std::string& text) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(number)) return std::nullopt;
    return number;
}

/// 0.1 and 1e-1 would be two runs of one case.
void refuse_equal_numbers(const YAML::Node& node, const SweepAxis& axis, Complaints& complaints) {
    std::map<double, std::string> seen;
    for (const SweepPoint& point : axis.points) {
        const auto number = number_in(point.text);
        if (!number) continue;
        const auto [first, is_new] = seen.emplace(*number, point.text);
        if (!is_new && first->second != point.text)  // equal texts are refused with the runs
            complaints.add(node,
                           fmt::format("sweep.{} has {} and {}, which are one value", axis.key,
                                       first->second, point.text),
                           "Every value of a sweep is a run.", "Keep one of the two.");
    }
}

void add_swept_keys(const std::string& prefix, const YAML::Node& node, StudyPart& part,
                    Complaints& complaints) {
    for (const auto& item : node) {
        const std::string key = prefix + item.first.Scalar();
        if (item.second.IsMap()) {
            add_swept_keys(key + ".", item.second, part, complaints);
            continue;
        }
        if (!item.second.IsSequence() || item.second.size() == 0) {
            complaints.add(
                item.first, "sweep." + key + " is not a list of values", "A swept key has a list.",
                "Write for example " + key + ": [1, 2, 3]; single values belong to set.");
            continue;
        }
        SweepAxis axis{key, {}};
        for (const YAML::Node& value : item.second)
            axis.points.push_back({value_text(value), {override_of(key, value)}});
        refuse_swept_before(item.first, key, part, complaints);
        refuse_equal_numbers(item.first, axis, complaints);
        part.axes.push_back(axis);
    }
}

void add_variants(const YAML::Node& node, StudyPart& part, Complaints& complaints) {
    if (!node.IsDefined()) return;
    if (!node.IsMap() || node.size() == 0) {
        complaints.add(node, "variants contains no names", "It is a map of names, each with keys.",
                       "Write for example variants: {md: {grains.adapter: yade-md}}.");
        return;
    }
    SweepAxis axis{"variant", {}};
    for (const auto& item : node) {
        const std::string name = item.first.Scalar();
        const bool plain = item.second.IsNull();  // a variant without keys of its own
        axis.points.push_back(
            {name, plain ? std::vector<std::string>{}
                         : overrides_of(item.second, "variants." + name, complaints)});
    }
    part.axes.push_back(axis);
}

void refuse_unknown_keys(const YAML::Node& node, const std::vector<std::string>& known,
                         Complaints& complaints) {
    std::set<std::string> seen;
    for (const auto& item : node) {
        const std::string key = item.first.Scalar();
        if (!seen.insert(key).second)
            complaints.add(item.first, key + " is given twice", "Only the first would be read.",
                           "Merge the two.");
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        complaints.add(item.first, key + " is unknown",
                       fmt::format("A study has {}.", fmt::join(known, ", ")),
                       did_you_mean(key, known, "Correct or remove it."));
    }
}

/// A run cannot have the value of its variant and that of the sweep, and its name says both.
void refuse_swept_in_variants(const YAML::Node& node, const StudyPart& part,
                              Complaints& complaints) {
    for (const SweepAxis& swept : part.axes)
        for (const SweepAxis& variants : part.axes)
            for (const SweepPoint& variant : variants.points)
                for (const std::string& one : variant.overrides)
                    if (variants.key == "variant" && key_of(one) == swept.key)
                        complaints.add(node,
                                       fmt::format("{}: variant {} sets {}, which is swept",
                                                   part.name, variant.text, swept.key),
                                       "A key of a run has one value.",
                                       "Take it out of the variants, or of the sweep.");
}

bool fits_a_folder(char c) {
    const auto letter = static_cast<unsigned char>(c);  // of UTF-8 above 127
    return std::isalnum(letter) != 0 || letter > 127 || std::string("._+-").find(c) < 4;
}

StudyPart read_part(const std::string& name, const YAML::Node& node, const fs::path& folder,
                    Complaints& complaints) {
    StudyPart part;
    part.name = name;
    if (!is_folder_name(name))
        complaints.add(node, "\"" + name + "\" is no name of a part",
                       "It becomes a folder: letters, digits and . _ + -, with no point first.",
                       "Choose another name.");
    if (!node.IsMap()) {
        complaints.add(node, name + " contains no keys", "A part is a map with a case.",
                       "Write for example " + name + ": {case: avalanche-dry.yaml}.");
        return part;
    }
    const YAML::Node file = node["case"];
    if (!file.IsDefined() || !file.IsScalar()) {
        complaints.add(node, name + " has no case", "Every part needs a case file.",
                       "Add case: FILE, with a path relative to the study file.");
    } else {
        const fs::path path = folder / file.Scalar();
        if (is_file(path))
            part.case_file = path;
        else
            complaints.add(file, "case: " + file.Scalar() + " does not exist",
                           "It is a case file, its path relative to the study file.",
                           "Looked for " + fs::absolute(path).lexically_normal().string() + ".");
    }
    part.overrides = overrides_of(node["set"], "set", complaints);
    part.full = overrides_of(node["full"], "full", complaints);
    part.quick = overrides_of(node["quick"], "quick", complaints);
    add_variants(node["variants"], part, complaints);
    const YAML::Node sweep = node["sweep"];
    if (sweep.IsDefined() && sweep.IsMap()) add_swept_keys("", sweep, part, complaints);
    refuse_swept_in_variants(node, part, complaints);
    if (sweep.IsDefined() && !sweep.IsMap())
        complaints.add(sweep, "sweep contains no keys", "It is a map `key: [values]`.",
                       "Write for example sweep: {random.seed: [1, 2, 3]}.");
    return part;
}

std::string figures_of(const YAML::Node& node, Complaints& complaints) {
    if (!node.IsDefined()) return "";
    const std::string name = node.IsScalar() ? node.Scalar() : "";
    if (std::find(figure_sets.begin(), figure_sets.end(), name) == figure_sets.end())
        complaints.add(node, "figures: " + value_text(node) + " is unknown",
                       fmt::format("It is one of {}.", fmt::join(figure_sets, ", ")),
                       "Leave it out for the figures of every study.");
    return name;
}

fs::path out_of(const YAML::Node& node, const std::string& study, Complaints& complaints) {
    if (!node.IsDefined()) return fs::path("runs") / study;
    if (!node.IsScalar() || node.Scalar().empty())
        complaints.add(node, "out: " + value_text(node) + " is no folder",
                       "It is the folder of the run folders.",
                       "Leave it out for runs/" + study + ".");
    return node.Scalar();
}

CaseRefused refused(const std::string& source, const YamlFault& fault) {
    return CaseRefused({problem_at(source, fault.line, fault.fault,
                                   "A study names cases and sweeps.", fault.remedy)});
}

YAML::Node document(const fs::path& file) {
    std::ifstream in(file);
    if (is_folder(file) || !in)
        throw CaseRefused({problem_at(file.string(), 0, "cannot be read",
                                      "A study file (YAML) is needed.", "Check the path.")});
    const YAML::Node result = yaml_tree({std::istreambuf_iterator<char>(in), {}});
    if (!result.IsMap()) throw YamlFault{0, "contains no keys", "See configs/ for examples."};
    return result;
}

void read_parts(const YAML::Node& parts, const fs::path& folder, Study& study,
                Complaints& complaints) {
    if (!parts.IsMap() || parts.size() == 0) {
        complaints.add(parts, "parts contains no names", "It is a map of names, each with a case.",
                       "Write for example parts: {column: {case: avalanche-dry.yaml}}.");
        return;
    }
    std::set<std::string> seen;
    for (const auto& item : parts) {
        if (!seen.insert(item.first.Scalar()).second)
            complaints.add(item.first, "part " + item.first.Scalar() + " is given twice",
                           "Its runs would be taken together.", "Give one of them another name.");
        if (item.second.IsMap()) refuse_unknown_keys(item.second, part_keys, complaints);
        study.parts.push_back(read_part(item.first.Scalar(), item.second, folder, complaints));
    }
}

/// Of the file, as a name of a folder: spaces and the like become underscores.
std::string name_of(const fs::path& file) {
    std::string name = file.stem().string();
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !fits_a_folder(c); }, '_');
    return name;
}

Study study_of(const YAML::Node& root, const fs::path& file) {
    Complaints complaints(file.filename().string());
    Study study;
    study.name = name_of(file);
    study.out = out_of(root["out"], study.name, complaints);
    study.figures = figures_of(root["figures"], complaints);
    const YAML::Node parts = root["parts"];
    if (!parts.IsDefined()) {
        std::vector<std::string> known = part_keys;
        known.insert(known.end(), {"out", "figures"});
        refuse_unknown_keys(root, known, complaints);
        study.parts = {read_part(study.name, root, file.parent_path(), complaints)};
    } else {
        refuse_unknown_keys(root, {"out", "figures", "parts"}, complaints);
        read_parts(parts, file.parent_path(), study, complaints);
    }
    study.problems = complaints.all();
    return study;
}

/// At its top level. False when it cannot be read: reading it says what is wrong.
bool has_one_of(const fs::path& file, const std::vector<std::string>& keys) {
    if (!is_file(file)) return false;
    try {
        const YAML::Node root = YAML::LoadFile(file.string());
        return root.IsMap() && std::any_of(keys.begin(), keys.end(), [&](const std::string& key) {
                   return root[key].IsDefined();
               });
    } catch (const YAML::Exception&) {
        return false;
    }
}

}  // namespace

bool is_folder_name(const std::string& name) {
    return !name.empty() && name[0] != '.' && std::all_of(name.begin(), name.end(), fits_a_folder);
}

bool is_study(const fs::path& file) {
    return has_one_of(file, {"parts", "case"});
}

bool is_case(const fs::path& file) {
    return has_one_of(file, {"domain", "grains"}) && !is_study(file);
}

Study read_study(const fs::path& file) {
    const std::string source = file.filename().string();
    try {
        return study_of(document(file), file);
    } catch (const YamlFault& fault) {
        throw refused(source, fault);
    } catch (const YAML::Exception& error) {
        throw refused(source, yaml_fault(error));
    }
}

}  // namespace turbidite
