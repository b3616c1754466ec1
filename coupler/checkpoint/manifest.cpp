// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/checkpoint/manifest.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace turbidite {
namespace {

using Json = nlohmann::ordered_json;

// Of the manifest and of the coupler's part (coupler_state.cpp, output_state.cpp): one higher with
// every change of either. 2: maxima of the motion and of contacts; 3: work of films, lengths of the
// outputs at the end of a part.
constexpr int format = 3;

Json file_json(const StoredFile& file) {
    return {{"name", file.name}, {"bytes", file.bytes}, {"crc32", file.crc32}};
}

StoredFile file_of(const Json& json) {
    return {json.at("name").get<std::string>(), json.at("bytes").get<std::int64_t>(),
            json.at("crc32").get<std::int64_t>()};
}

Json list_json(const std::vector<StoredFile>& files) {
    Json list = Json::array();
    for (const StoredFile& file : files) list.push_back(file_json(file));
    return list;
}

std::vector<StoredFile> list_of(const Json& json) {
    std::vector<StoredFile> files;
    for (const Json& one : json) files.push_back(file_of(one));
    return files;
}

Json settings_json(const Settings& settings) {
    Json json = Json::object();
    for (const auto& [key, value] : settings.entries()) json[key] = value;
    return json;
}

Settings settings_of(const Json& json) {
    Settings settings;
    for (const auto& [key, value] : json.items()) settings.set(key, value.get<std::string>());
    return settings;
}

}  // namespace

std::vector<StoredFile> Manifest::files() const {
    std::vector<StoredFile> all{coupler};
    all.insert(all.end(), fluid.begin(), fluid.end());
    all.insert(all.end(), grains.begin(), grains.end());
    return all;
}

std::string manifest_text(const Manifest& manifest) {
    const std::string protocol =
        std::to_string(protocol_major) + "." + std::to_string(protocol_minor);
    const Json json = {
        {"format", format},
        {"protocol", protocol},
        {"case_hash", manifest.case_hash},
        {"windows", manifest.windows},
        {"time", manifest.time},
        {"ranks", {{"fluid", manifest.fluid.size()}, {"grains", manifest.grains.size()}}},
        {"files",
         {{"coupler", file_json(manifest.coupler)},
          {"fluid", list_json(manifest.fluid)},
          {"grains", list_json(manifest.grains)}}},
        {"settings", settings_json(manifest.settings)}};
    // replace: names come from other programs, and a byte that is not UTF-8 would make this throw.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Manifest parse_manifest(const std::string& text) {
    try {
        const Json json = Json::parse(text);
        // Before anything else is read: in another format the rest may mean something else.
        if (json.at("format") != format)
            throw std::runtime_error("format " + json.at("format").dump() + " instead of " +
                                     std::to_string(format) + ", of another version of Turbidite");
        const Json& files = json.at("files");
        return {json.at("case_hash").get<std::string>(),
                json.at("windows").get<std::int64_t>(),
                json.at("time").get<double>(),
                settings_of(json.at("settings")),
                file_of(files.at("coupler")),
                list_of(files.at("fluid")),
                list_of(files.at("grains"))};
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error("not the manifest of a checkpoint");
    }
}

}  // namespace turbidite
