// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A key of a case file: type, unit, range or choices, default, help. Tables of keys are in the same
// files as the rules that several keys must satisfy together (rule.hpp).
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

enum class KeyType { text, choice, real, integer, flag, real_list };

/// A value of a choice. Values planned for later versions are known, and refused as such.
struct Choice {
    std::string name;
    std::string help;
    bool available = true;
};

struct Range {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
    bool lower_open = false;  ///< the bound itself is not allowed
    bool upper_open = false;

    bool contains(double value) const;
};

/// How a grains adapter makes contacts: impulses of rigid grains, or springs; `any` is both, or not
/// known.
enum class Contacts { any, rigid, springs };

/// When a key must be given: `fallback` keys have a default, `optional` ones may be omitted.
enum class Need { fallback, required, optional, conditional };

/// What a key says otherwise with dimension: 3.
struct InSpace {
    int entries = 0;                           ///< of a list; 0: as in the plane
    std::string allowed = {};                  ///< empty: as in the plane
    std::string remedy = {};                   ///< the same
    std::optional<std::string> fallback = {};  ///< none: as in the plane; empty: no default
};

/// A part of a name in capitals is a placeholder for a user-defined word:
/// "contact.materials.NAME.friction".
struct KeySpec {
    std::string name;  ///< "contact.friction"
    KeyType type = KeyType::real;
    std::string unit = {};  ///< "D", "t_c", "u_c", "s"; "" for pure numbers
    Need need = Need::fallback;
    std::string fallback = {};  ///< default as text
    Range range = {};           ///< of numbers, and of every entry of a list
    std::vector<Choice> choices = {};
    std::string help = {};     ///< what it means
    std::string allowed = {};  ///< one sentence, shown with a refusal; generated if empty
    std::string remedy = {};   ///< one sentence: what to do
    int entries = 2;           ///< of a list; 0: any number
    std::string when = {};     ///< conditional: when it is required, in words
    bool (*required)(const Settings&) = nullptr;  ///< conditional: the same, as a test
    bool available = true;                        ///< false: planned for a later version
    Contacts contacts = Contacts::any;            ///< of the grains adapters that know it
    /// Why it has no effect in a case whose other keys are valid ("without a fluid"); empty if it
    /// has one.
    std::string (*idle)(const Settings&) = nullptr;
    int dimension = 0;  ///< of the cases that have the key: 2 or 3; 0: all
    InSpace in_space = {};
};
using KeyTable = std::vector<KeySpec>;

/// The key with this name, nullptr if there is none.
const KeySpec* find_key(const KeyTable& table, const std::string& name);

/// A key, with its default or an optional one, that cases in the plane do not have.
KeySpec of_space(KeySpec key);

/// The key as it is in cases of this dimension.
KeySpec in_dimension(const KeySpec& key, int dimension);

/// "contact", "friction".
std::vector<std::string> parts_of(const std::string& name);

/// `domain.motions.NAME.kind` with the words of `domain.motions.shake.kin`, so that it can be
/// written into the case; as it is where the two do not have the same parts.
std::string with_words_of(const std::string& written, const std::string& name);

/// True if its name has parts in capitals.
bool has_words(const KeySpec& key);

/// What the key accepts, as a sentence: "A number above 0.", "One of split."
std::string allowed_values(const KeySpec& key);

/// "a number", "a whole number", …
std::string type_name(KeyType type);

/// "contact" of "contact.friction"; empty for keys outside any group.
std::string group_of(const std::string& key);

/// True if the key has this value.
bool is(const Settings& settings, const char* key, const char* value);

/// Whether the case has dimension: 3.
bool in_space(const Settings& settings);

inline constexpr Range positive{.lower = 0.0, .lower_open = true};
inline constexpr Range not_negative{.lower = 0.0};
inline constexpr Range open_unit_interval{
    .lower = 0.0, .upper = 1.0, .lower_open = true, .upper_open = true};

}  // namespace turbidite
