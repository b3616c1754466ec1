// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/launch_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>

#include "launcher/case/files/command_words.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/job/folder/run_lock.hpp"

namespace turbidite {
namespace {

using Arguments = std::vector<std::string>;

std::filesystem::path grains_file(const GrainsAdapter& adapter, const Programs& programs) {
    const bool script = adapter.host == GrainsHost::yade;
    return (script ? programs.yade_folder() : programs.folder) / adapter.file;
}

// -x: a Python error ends the program instead of opening a prompt, where the job would hang.
Arguments grains_command(const Settings& settings, const Programs& programs,
                         const std::string& run) {
    const GrainsAdapter& adapter = grains_adapter(settings);
    if (adapter.host == GrainsHost::command) {
        Arguments words = *command_words(settings.text("grains.command"));
        words.push_back(run);
        return words;
    }
    const std::string file = grains_file(adapter, programs);
    if (adapter.host == GrainsHost::none) return {file, run};
    return {programs.yade(), "-n", "-x", file, run};
}

void append(Arguments& to, const Arguments& more) {
    to.insert(to.end(), more.begin(), more.end());
}

std::string python_path(const LaunchSite& site) {
    const std::string ours =
        site.programs.yade_folder().string() + ":" + site.programs.python_module().string();
    return site.python.empty() ? ours : ours + ":" + site.python;
}

Arguments fluid_command(const Settings& settings, const RunFolder& folder,
                        const Programs& programs) {
    Arguments part{programs.fluid(fluid_program(settings))};
    for (std::size_t i = 1; i < programs.other_fluid.size(); ++i)
        part.push_back(programs.other_fluid[i]);
    append(part, {"-case", folder.fluid()});
    // OpenFOAM's way: without it a program takes itself for the only process.
    if (settings.integer("fluid.ranks") > 1) part.push_back("-parallel");
    return part;
}

/// The programs of a job, each with the world ranks after those of the program before it.
class Parts {
 public:
    Parts(const LaunchSite& site, const RunFolder& folder) : site_(site), folder_(folder) {}

    // mpirun exports -x to the program of the same part only, so every part repeats it.
    void add(const std::string& role, std::int64_t ranks, const Arguments& command) {
        if (!line_.empty()) line_.push_back(":");
        append(line_, {"-x", "WM_PROJECT_DIR=" + site_.openfoam, "-x", "OMP_NUM_THREADS=1", "-x",
                       "PYTHONPATH=" + python_path(site_), "-n", std::to_string(ranks),
                       // Every rank is started by turbidite-member, which does not use MPI and
                       // notices how it ends (docs/decisions/job.md).
                       site_.programs.member(), folder_.root, role, std::to_string(first_),
                       std::to_string(ranks)});
        append(line_, command);
        first_ += ranks;
    }

    /// A participant of the case.
    void add(const std::string& role, const Settings& settings, const Programs& programs) {
        const std::int64_t ranks = settings.integer(role + ".ranks");
        add(role, ranks,
            role == "fluid" ? fluid_command(settings, folder_, programs)
                            : grains_command(settings, programs, folder_.root));
    }

    const Arguments& line() const { return line_; }

 private:
    const LaunchSite& site_;
    const RunFolder& folder_;
    std::int64_t first_ = 0;
    Arguments line_;
};

bool is_plain(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_-+=./:,@%", c) != nullptr;
}

std::string shell_quoted(const std::string& text) {
    if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
    std::string quoted = "'";
    // A quote ends the text, stands escaped, and begins it again.
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace

LaunchSite this_site() {
    const char* openfoam = std::getenv("WM_PROJECT_DIR");
    const char* python = std::getenv("PYTHONPATH");
    return {.programs = find_programs(),
            .as_root = geteuid() == 0,
            .openfoam = openfoam ? openfoam : "/usr/share/openfoam",
            .python = python ? python : ""};
}

// Most containers forbid copying between processes through the kernel; mpirun would print a
// warning.
std::vector<std::string> mpirun_options(const LaunchSite& site) {
    Arguments options{"mpirun"};
    if (site.as_root) options.push_back("--allow-run-as-root");
    append(options, {"--oversubscribe", "--bind-to", "none", "--mca",
                     "btl_vader_single_copy_mechanism", "none"});
    return options;
}

std::vector<std::string> launch_arguments(const Settings& settings, const RunFolder& folder,
                                          const LaunchSite& site, const std::string& checkpoint) {
    const Programs& programs = site.programs;
    Arguments line = mpirun_options(site);
    Parts parts(site, folder);
    Arguments coupler{programs.coupler(), folder.root};
    if (!checkpoint.empty()) coupler.push_back(checkpoint);
    // First, so that it is world rank 0, to which all others announce themselves.
    parts.add("coupler", 1, coupler);
    if (settings.flag("fluid.enabled")) parts.add("fluid", settings, programs);
    parts.add("grains", settings, programs);
    append(line, parts.line());
    return line;
}

std::vector<std::string> replay_arguments(const Settings& settings, const RunFolder& folder,
                                          const LaunchSite& site, const std::string& role,
                                          const std::filesystem::path& recording) {
    Arguments line = mpirun_options(site);
    Parts parts(site, folder);
    parts.add("coupler", 1, {site.programs.replay(), folder.root, role, recording});
    parts.add(role, settings, site.programs);
    append(line, parts.line());
    return line;
}

std::vector<std::string> under_lock(std::vector<std::string> line) {
    // Of the first program, the coupler. -x: on whichever node it runs.
    const auto exports = std::find(line.begin(), line.end(), "-x");
    const std::string held = std::string(RunLock::held_variable) + "=1";
    line.insert(exports, {"-x", held});
    return line;
}

std::vector<std::string> rank_names(const Settings& settings) {
    std::vector<std::string> names{"coupler"};
    const auto add = [&](const std::string& role) {
        for (std::int64_t rank = 0; rank < settings.integer(role + ".ranks"); ++rank)
            names.push_back(role + " rank " + std::to_string(rank));
    };
    if (settings.flag("fluid.enabled")) add("fluid");
    add("grains");
    return names;
}

std::string shell_line(const std::vector<std::string>& arguments) {
    std::string line;
    for (const std::string& argument : arguments) {
        if (!line.empty()) line += ' ';
        line += shell_quoted(argument);
    }
    return line;
}

std::vector<std::filesystem::path> needed_programs(const Settings& settings,
                                                   const Programs& programs) {
    std::vector<std::filesystem::path> needed{programs.coupler(), programs.member()};
    if (settings.flag("fluid.enabled")) needed.push_back(programs.fluid(fluid_program(settings)));
    if (has_openfoam(settings) && !programs.scripted_fluid) {
        const auto blockmesh = find_program_file("blockMesh");
        needed.push_back(blockmesh.empty() ? "blockMesh of OpenFOAM 1912 (Debian package openfoam)"
                                           : blockmesh);
    }
    const GrainsAdapter& adapter = grains_adapter(settings);
    if (adapter.host == GrainsHost::command) return needed;  // require_command
    if (adapter.host == GrainsHost::yade) {
        needed.push_back(programs.yade());
        needed.push_back(programs.yade_extension());
    }
    needed.push_back(grains_file(adapter, programs));
    return needed;
}

}  // namespace turbidite
