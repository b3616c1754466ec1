// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/doctor/machine.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "launcher/case/forecast/gigabyte.hpp"
#include "launcher/doctor/command_output.hpp"

namespace turbidite {
namespace {

constexpr double enough = gigabyte;  // of memory, compiling one OpenFOAM source takes as much

Diagnosis free_disk() {
    std::error_code error;
    const auto space = std::filesystem::space(".", error);
    if (error) return {Health::wrong, "free disk", error.message(), "df -h ."};
    const auto available = static_cast<double>(space.available);
    return {available < enough ? Health::wrong : Health::ok, "free disk",
            fmt::format("{:.1f} GB in this folder", available / gigabyte),
            available < enough ? "df -h ." : ""};
}

/// A line of /proc/meminfo, in bytes.
double memory(const std::string& name) {
    std::ifstream lines("/proc/meminfo");
    for (std::string line; std::getline(lines, line);)
        if (line.rfind(name + ":", 0) == 0) return 1024.0 * std::stod(line.substr(name.size() + 1));
    return 0.0;
}

Diagnosis free_memory() {
    const double available = memory("MemAvailable");
    return {available < enough ? Health::wrong : Health::ok, "free memory",
            fmt::format("{:.1f} of {:.1f} GB", available / gigabyte, memory("MemTotal") / gigabyte),
            available < enough ? "ps aux --sort=-rss | head" : ""};
}

/// Starts two processes as a run does: mpirun refuses root and too many ranks without options.
Diagnosis mpirun_starts(const LaunchSite& site) {
    std::vector<std::string> line = mpirun_options(site);
    line.insert(line.end(), {"-n", "2", "true"});
    const CommandOutput output = output_of(line);
    const std::string user = site.as_root ? "as root, with the flag for it" : "as this user";
    if (output.code == 0) return {Health::ok, "mpirun may run", user, ""};
    if (output.code == 127)
        return {Health::missing, "mpirun may run", "no mpirun", install_command("openmpi-bin")};
    return {Health::wrong, "mpirun may run", first_words(output.text), shell_line(line)};
}

}  // namespace

Diagnoses state_of_machine(const LaunchSite& site) {
    return {free_disk(), free_memory(), mpirun_starts(site)};
}

}  // namespace turbidite
