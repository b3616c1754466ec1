// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/run_json.hpp"

#include <fstream>

#include "coupler/protocol/files/whole_file.hpp"
#include "launcher/version.hpp"

namespace turbidite {

nlohmann::ordered_json read_run_json(const std::filesystem::path& file) {
    std::ifstream input(file);
    nlohmann::ordered_json record = nlohmann::ordered_json::parse(input, nullptr, false);
    return record.is_object() ? record : nlohmann::ordered_json::object();
}

nlohmann::ordered_json own_versions() {
    return {{"turbidite", version()}, {"commit", commit()}};
}

void write_run_json(const std::filesystem::path& file, const nlohmann::ordered_json& record) {
    // Paths and arguments need not be UTF-8.
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    write_whole_on_disk(
        file, [&](std::ostream& out) { out << record.dump(2, ' ', false, replace) << "\n"; });
}

}  // namespace turbidite
