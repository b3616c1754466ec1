// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/commands/key_schema.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "launcher/case/keys/keys.hpp"

namespace turbidite {
namespace {

using Json = nlohmann::ordered_json;

/// A part in capitals stands for any word.
bool is_placeholder(const std::string& part) {
    return !part.empty() && std::isupper(static_cast<unsigned char>(part.front())) != 0;
}

const char* json_type(KeyType type) {
    switch (type) {
        case KeyType::real:
            return "number";
        case KeyType::integer:
            return "integer";
        case KeyType::flag:
            return "boolean";
        case KeyType::real_list:
            return "array";
        default:
            return "string";
    }
}

void set_range(Json& schema, const Range& range) {
    if (std::isfinite(range.lower))
        schema[range.lower_open ? "exclusiveMinimum" : "minimum"] = range.lower;
    if (std::isfinite(range.upper))
        schema[range.upper_open ? "exclusiveMaximum" : "maximum"] = range.upper;
}

/// A choice such as 2 is a number in YAML.
void set_choices(Json& schema, const KeySpec& key) {
    schema.erase("type");
    for (const Choice& choice : key.choices) {
        if (!choice.available) continue;
        schema["enum"].push_back(choice.name);
        if (std::isdigit(static_cast<unsigned char>(choice.name.front())) != 0)
            schema["enum"].push_back(std::stod(choice.name));
    }
}

void set_entries(Json& schema, const KeySpec& key) {
    schema["items"] = {{"type", "number"}};
    set_range(schema["items"], key.range);
    if (key.entries == 0) return;
    const int in_space = key.in_space.entries == 0 ? key.entries : key.in_space.entries;
    schema["minItems"] = std::min(key.entries, in_space);
    schema["maxItems"] = std::max(key.entries, in_space);
}

/// `~`, which takes a key out of a case.
void allow_nothing(Json& schema) {
    if (schema.contains("enum"))
        schema["enum"].push_back(nullptr);
    else
        schema["type"] = {schema["type"], "null"};
}

Json schema_of(const KeySpec& key) {
    Json schema = {{"description", key.unit.empty() ? key.help : key.help + " [" + key.unit + "]"},
                   {"type", json_type(key.type)}};
    if (key.type == KeyType::real || key.type == KeyType::integer) set_range(schema, key.range);
    if (key.type == KeyType::choice) set_choices(schema, key);
    if (key.type == KeyType::real_list) set_entries(schema, key);
    allow_nothing(schema);
    if (key.need == Need::fallback && !key.fallback.empty())
        schema["description"] =
            schema["description"].get<std::string>() + "; default " + key.fallback;
    return schema;
}

/// The schema of a part of a name below `group`, made where it is missing.
Json& below(Json& group, const std::string& part) {
    group["type"] = "object";
    if (!group.contains("additionalProperties")) group["additionalProperties"] = false;
    if (!is_placeholder(part)) return group["properties"][part];
    Json& any = group["additionalProperties"];
    if (any.is_boolean()) any = Json::object();
    return any;
}

}  // namespace

std::string key_schema() {
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"title", "Turbidite case"}};
    for (const KeySpec& key : key_table()) {
        if (!key.available) continue;
        Json* at = &schema;
        for (const std::string& part : parts_of(key.name)) at = &below(*at, part);
        *at = schema_of(key);
    }
    return schema.dump(2) + "\n";
}

}  // namespace turbidite
