// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/prepare_run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <fstream>

#include "coupler/checkpoint/checkpoint_sets.hpp"
#include "coupler/protocol/case_hash.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/whole_file.hpp"
#include "coupler/protocol/hello.hpp"
#include "fluid_adapter/foam_case/fluid_case.hpp"
#include "launcher/case/files/command_words.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/case/resolved_text.hpp"
#include "launcher/job/folder/openfoam_path.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/job/folder/run_on_disk.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {

std::string local_time(const char* form) {
    const std::tm now = fmt::localtime(std::time(nullptr));
    char text[64];
    std::strftime(text, sizeof text, form, &now);
    return text;
}

namespace {

namespace fs = std::filesystem;

bool fits_a_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
}

// Two runs started within one second, even at the same time, get different numbers: the one that
// creates the folder owns it.
fs::path fresh_folder(std::string case_name) {
    std::replace_if(
        case_name.begin(), case_name.end(), [](char c) { return !fits_a_name(c); }, '_');
    const fs::path wanted = fs::path("runs") / (case_name + "-" + local_time("%Y%m%d-%H%M%S"));
    fs::create_directories("runs");
    fs::path folder = wanted;
    for (int i = 2; !fs::create_directory(folder); ++i)
        folder = wanted.string() + "-" + std::to_string(i);
    return folder;
}

/// Written before the case, whole or not: left by a run that was killed, or found the disk full,
/// before it had a case.
bool precedes_the_case(const fs::path& file, const RunFolder& folder) {
    const std::string name = file.string();
    return file == folder.root / RunLock::file ||
           name.rfind(folder.initial_grains().string(), 0) == 0 ||
           name.rfind(folder.walls().string(), 0) == 0;
}

bool holds_something(const RunFolder& folder) {
    return std::any_of(fs::recursive_directory_iterator(folder.root),
                       fs::recursive_directory_iterator(), [&](const fs::directory_entry& entry) {
                           return !entry.is_directory() && !precedes_the_case(entry.path(), folder);
                       });
}

/// A user's own folder may have a case.yaml too.
bool is_resolved_case(const fs::path& file) {
    std::ifstream in(file);
    std::string first;
    return std::getline(in, first) && first.rfind(resolved_head, 0) == 0;
}

bool is_run_folder(const RunFolder& folder) {
    return fs::exists(folder.record()) || is_resolved_case(folder.resolved_case());
}

// Removes only what a run writes, so that a mistyped --out with --force deletes nothing else.
void empty_run_folder(const RunFolder& folder) {
    for (const fs::path& part :
         {folder.history(), folder.grains(), folder.fluid(), folder.logs(), folder.report(),
          folder.pictures(), folder.film(), folder.view(), folder.checkpoints(), folder.stop(),
          folder.root / write_file, folder.root / checkpoint_file, folder.recordings(),
          folder.root / "timeline", folder.root / "differences", folder.root / "contacts",
          folder.root / "probes.csv"})
        fs::remove_all(part);
    CheckpointSets(folder.root).remove_unfinished();
    // Last: they say that the folder is one that may be emptied.
    for (const fs::path& part : {folder.record(), folder.resolved_case()}) fs::remove(part);
}

Failure folder_refused(const fs::path& out, const std::string& fault, const std::string& remedy) {
    return Failure(ExitCode::bad_input,
                   fmt::format("--out = {} {}\n  {}\nNothing was started. Exit code 2.",
                               out.string(), fault, remedy));
}

void write_text(const fs::path& file, const std::string& text) {
    write_whole(file, [&](std::ostream& out) { out << text; });
}

/// By the shape index of the grains; corners as x, y for unit circumscribed radius.
nlohmann::ordered_json shape_table(const ShapeTable& shapes) {
    auto table = nlohmann::ordered_json::array();
    for (const ShapeRecord& shape : shapes)
        table.push_back({{"kind", shape.kind}, {"vertices", shape.vertices}});
    return table;
}

/// Null without a fluid.
nlohmann::ordered_json fluid_program_of(const Settings& settings) {
    if (!settings.flag("fluid.enabled")) return nullptr;
    return program_name(fluid_program(settings));
}

/// Of grains.extra_file, whose grains initial.csv has among all others; empty without.
std::string extra_fingerprint(const ResolvedCase& resolved) {
    if (!resolved.settings.has("grains.extra_file")) return "";
    const fs::path file = resolved.file.parent_path() / resolved.settings.text("grains.extra_file");
    // A run folder has no copy of it.
    return fs::exists(file) ? case_hash(read_whole(file)) : "";
}

/// `turbidite resume` adds others.
nlohmann::ordered_json first_part() {
    return {{"started", local_time("%Y-%m-%dT%H:%M:%S%z")},
            {"from_window", 0},
            {"windows_done", 0},
            {"status", "prepared"}};
}

nlohmann::ordered_json first_record(const ResolvedCase& resolved, const RunFolder& folder,
                                    const std::vector<std::string>& command) {
    const Scales& scales = resolved.scales;
    return {{"status", "prepared"},
            {"exit_code", nullptr},
            {"error", ""},
            {"case", resolved.name},
            {"case_file", resolved.file.string()},
            {"overrides", resolved.overrides},
            {"given", resolved.given},
            {"from", resolved.from},
            {"out", folder.root.string()},
            {"case_hash", resolved.settings.text("run.hash")},
            {"hash_before_pouring", resolved.hash_before_pouring},
            {"extra_grains", extra_fingerprint(resolved)},
            {"versions", own_versions()},
            {"prepared", local_time("%Y-%m-%dT%H:%M:%S%z")},
            {"scales", scales.kind},
            {"D", scales.diameter},
            {"u_c", scales.velocity},
            {"t_c", scales.time},
            {"g", scales.gravity},
            {"rho", scales.fluid_density},
            {"nu", scales.viscosity},
            {"reynolds", scales.reynolds},
            {"fluid_program", fluid_program_of(resolved.settings)},
            {"seed", resolved.settings.integer("random.seed")},
            {"grains", resolved.population.size()},
            {"shapes", shape_table(resolved.shapes)},
            {"windows", resolved.settings.integer("run.windows")},
            {"notes", resolved.notes},
            {"command", shell_line(command)},
            {"parts", {first_part()}}};
}

}  // namespace

namespace {

OwnFolder folder_for(const fs::path& wanted, const RunOrder& order) {
    // The trailing slash of `--out DIR/` would become an empty last part.
    const RunFolder folder{fs::path(fs::absolute(wanted / ".").lexically_normal()).parent_path()};
    if (order.for_openfoam && !openfoam_finds(folder.root))
        throw folder_refused(folder.root, "has a space, a quote or a backslash in its path",
                             order.out.empty()
                                 ? "OpenFOAM changes these in file names. Start it in another "
                                   "folder, or give one with --out."
                                 : "OpenFOAM changes these in file names. Choose another --out.");
    if (fs::exists(folder.root) && !fs::is_directory(folder.root))
        throw folder_refused(wanted, "is a file", "Choose another --out.");
    fs::create_directories(folder.root);
    std::shared_ptr<RunLock> lock = RunLock::take(folder.root);
    if (!lock)
        throw folder_refused(wanted, RunLock::in_use,
                             "Wait for it, stop it, or choose another --out.");
    // Only what looks like a run is emptied, and only with the lock.
    if (order.force && is_run_folder(folder))
        empty_run_folder(folder);
    else if (holds_something(folder))
        throw folder_refused(
            wanted, is_run_folder(folder) ? "is not empty" : "is not empty, and no run is in it",
            std::string("A run needs a new or empty folder. Choose another --out") +
                (is_run_folder(folder) ? ", or add --force to overwrite the run that is there."
                                       : "."));
    for (const fs::path& part : {folder.grains(), folder.logs()}) fs::create_directories(part);
    return {folder, lock};
}

}  // namespace

OwnFolder own_run_folder(const RunOrder& order, const std::string& case_name) {
    fs::path wanted = order.out;
    try {
        if (wanted.empty()) wanted = fresh_folder(case_name);
        return folder_for(wanted, order);
    } catch (const fs::filesystem_error& error) {
        throw folder_refused(wanted.empty() ? "runs" : wanted,
                             "cannot be created: " + error.code().message(),
                             "Choose a folder you may write to.");
    }
}

RunFolder make_run_folder(const RunOrder& order, const std::string& case_name) {
    return own_run_folder(order, case_name).folder;
}

namespace {

void build_fluid(const Settings& settings, const RunFolder& folder, FluidMesh mesh) {
    if (!has_openfoam(settings)) return;
    write_fluid_case(settings, folder.fluid());
    if (mesh == FluidMesh::left_out) return;
    build_fluid_mesh(folder.fluid(), folder.log("blockMesh"));
    if (settings.integer("fluid.ranks") > 1)
        decompose_fluid_case(folder.fluid(), folder.log("decomposePar"));
}

}  // namespace

FluidMesh mesh_of_replay(const std::string& role) {
    return role == role_name(Role::fluid) ? FluidMesh::built : FluidMesh::left_out;
}

void prepare_run(const ResolvedCase& resolved, const RunFolder& folder,
                 const std::vector<std::string>& command, FluidMesh mesh) {
    // The run folder holds everything that the case names: it can be read, moved and resumed by
    // itself.
    write_text(folder.initial_grains(), resolved.grains_csv);
    if (!resolved.walls_csv.empty()) write_text(folder.walls(), resolved.walls_csv);
    if (resolved.settings.has("grains.script"))
        write_text(folder.root / resolved.settings.text("grains.script"), resolved.script);
    if (const std::string& functions = resolved.functions.text; !functions.empty()) {
        const fs::path file = folder.root / resolved.settings.text("fluid.functions");
        fs::create_directories(file.parent_path());
        write_text(file, functions);
    }
    // After the files that it names: a folder with a case can be read, whenever this program ends.
    write_text(folder.resolved_case(), resolved.yaml);
    write_run_json(folder.record(), first_record(resolved, folder, command));
    build_fluid(resolved.settings, folder, mesh);
    put_run_on_disk(folder);
}

void add_view(const RunFolder& folder, const Programs& programs) {
    if (fs::exists(folder.view())) return;  // a grains.script of that name
    write_whole(folder.view(),
                [&](std::ostream& out) { out << std::ifstream(programs.view()).rdbuf(); });
}

namespace {

void require_command(const Settings& settings) {
    if (grains_adapter(settings).host != GrainsHost::command) return;
    const std::string program = command_words(settings.text("grains.command"))->front();
    if (!find_program_file(program).empty()) return;
    const bool named = program.find('/') != std::string::npos;
    throw Failure(
        ExitCode::bad_input,
        fmt::format("grains.command = {}\n  There is no executable program {}{}. Give its path, "
                    "relative to the case file or absolute, or make it executable.\nNothing was "
                    "started. Exit code 2.",
                    settings.text("grains.command"), program, named ? "" : " in PATH"));
}

/// OpenFOAM starts wmake for what it compiles, and refuses to do so for root.
void require_compiler(const ResolvedCase& resolved) {
    if (resolved.functions.compiled.empty()) return;
    const bool root = ::geteuid() == 0;
    if (!root && !find_program_file("wmake").empty()) return;
    const CompiledPart& part = resolved.functions.compiled.front();
    throw Failure(
        ExitCode::bad_input,
        fmt::format("{} line {}: fluid.functions has {}, which OpenFOAM compiles {}\n  Compile the "
                    "code yourself and name the library: libs (\"/path/to/libmine.so\"); "
                    "(docs/function-objects.md){}.\nNothing was started. Exit code 2.",
                    part.source, part.line, part.what,
                    root ? "for nobody with the rights of root"
                         : "with wmake, and there is none in PATH (Debian's OpenFOAM has none)",
                    root ? ", or run as another user" : ", or put a wmake into PATH"));
}

}  // namespace

void require_programs(const ResolvedCase& resolved, const std::vector<fs::path>& needed) {
    const Settings& settings = resolved.settings;
    require_command(settings);
    require_compiler(resolved);
    for (const fs::path& program : needed) {
        if (fs::exists(program)) continue;
        throw Failure(
            ExitCode::bad_input,
            fmt::format(
                "{} is missing, but the case needs it (grains.adapter = {}, "
                "fluid.enabled = {}, "
                "fluid.program = {})\n  Build or install it with ./turbidite, or "
                "choose another adapter or fluid.program.\nNothing was started. Exit code 2.",
                program.string(), settings.text("grains.adapter"), settings.text("fluid.enabled"),
                program_name(fluid_program(settings))));
    }
}

}  // namespace turbidite
