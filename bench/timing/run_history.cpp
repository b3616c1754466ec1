// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/timing/run_history.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include "bench/timing/site.hpp"

namespace turbidite::bench {

RunHistory read_history(const std::filesystem::path& run) {
    std::ifstream file(run / "history.csv");
    std::string line, cell;
    std::getline(file, line);
    std::vector<std::string> names;
    for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
    RunHistory columns;
    while (std::getline(file, line)) {
        std::istringstream row(line + ",");
        for (std::size_t i = 0; i < names.size() && std::getline(row, cell, ','); ++i)
            columns[names[i]].push_back(cell.empty() ? NAN : std::stod(cell));
    }
    return columns;
}

std::filesystem::path play_case(Site& site, const std::string& the_case, const std::string& name,
                                const std::vector<std::string>& changes) {
    const std::filesystem::path run = site.folder() / name;
    std::vector<std::string> line{site.programs().folder / "turbidite",
                                  "run",
                                  site.programs().source / "configs" / the_case,
                                  "--force",
                                  "--out",
                                  run.string()};
    for (const std::string& change : changes) line.insert(line.end(), {"--set", change});
    site.run(line, name + ".log");
    return run;
}

}  // namespace turbidite::bench
