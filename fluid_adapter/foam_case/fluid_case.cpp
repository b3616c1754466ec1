// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/foam_case/fluid_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <regex>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/whole_file.hpp"
#include "coupler/protocol/run_values.hpp"
#include "fluid_adapter/domain/fluid_domain.hpp"
#include "fluid_adapter/domain/side_motion.hpp"

namespace turbidite {
namespace {

std::string header(const std::string& type, const std::string& location, const std::string& name) {
    return fmt::format(
        "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {};\n"
        "    location    \"{}\";\n    object      {};\n}}\n\n",
        type, location, name);
}

void write(const std::filesystem::path& directory, const std::string& location,
           const std::string& name, const std::string& type, const std::string& body) {
    const std::filesystem::path folder = directory / location;
    std::filesystem::create_directories(folder);
    std::ofstream file(folder / name);
    file << header(type, location, name) << body;
    file.close();
    if (!file)
        throw Failure(ExitCode::participant_failed, "cannot write " + (folder / name).string());
}

/// The function objects are a file of its own, which the program that makes the run folder writes.
std::string functions_of(const Settings& settings) {
    return settings.has("fluid.functions") ? "functions\n{\n    #include \"functions\"\n}\n" : "";
}

std::string control_dict(const Settings& settings, const RunValues& run) {
    const double end = run.step * static_cast<double>(run.windows);
    // The coupler decides when fields are written; OpenFOAM's own write interval is set beyond the
    // end.
    return fmt::format(
        "application     turbidite-fluid;\n"
        "startFrom       startTime;\n"
        "startTime       0;\n"
        "stopAt          endTime;\n"
        "endTime         {:.17g};\n"
        "deltaT          {:.17g};\n"
        "writeControl    timeStep;\n"
        "writeInterval   2000000000;\n"
        "purgeWrite      0;\n"
        "writeFormat     binary;\n"
        "writePrecision  10;\n"
        "writeCompression off;\n"
        "timeFormat      general;\n"
        "timePrecision   10;\n"
        "runTimeModifiable no;\n"
        "{}",
        end, run.step, functions_of(settings));
}

/// The flux between rows of different heights weighs velocities by volumes (reverseLinear): then
/// the gradient of p is minus the transpose of the divergence (box_step/row_heights.hpp).
std::string schemes(const Settings& settings, const FluidDomain& domain) {
    return fmt::format(
        "ddtSchemes           {{ default Euler; }}\n"
        "gradSchemes          {{ default Gauss linear; }}\n"
        "divSchemes           {{ default none; div(phi,U) {}; }}\n"
        "laplacianSchemes     {{ default Gauss linear orthogonal; }}\n"
        "interpolationSchemes {{ default {}; }}\n"
        "snGradSchemes        {{ default orthogonal; }}\n",
        settings.text("fluid.transport_scheme"), stretched(domain) ? "reverseLinear" : "linear");
}

/// One value of fluid.pressure_solver or fluid.viscous_solver, and its dictionary entry without
/// tolerance.
struct SolverEntry {
    const char* name;
    const char* entry;
};

/// Direct: one solve is exact to rounding, whatever the first guess.
constexpr SolverEntry fft = {"FFT", "solver FFT; minIter 1;"};
constexpr SolverEntry pcg = {"PCG", "solver PCG; preconditioner DIC;"};
constexpr SolverEntry gamg = {"GAMG",
                              "solver GAMG; smoother GaussSeidel; nPreSweeps 1; nPostSweeps 2; "
                              "nCellsInCoarsestLevel 20;"};

/// Tolerance for FFT, above its rounding error; the tolerances of the case are for iterative
/// solvers.
constexpr double direct_tolerance = 1e-9;

/// Tolerances are OpenFOAM's normalised residuals, and so relative to the size of the problem; a
/// relTol would be relative to the error of the first guess instead.
std::string solver(const Settings& settings, const std::string& problem,
                   std::initializer_list<SolverEntry> list, int most_iterations) {
    const std::string key = "fluid." + problem + "_solver", name = settings.text(key);
    std::string names;
    for (const SolverEntry& entry : list) {
        if (entry.name == name)
            return fmt::format("{} tolerance {:.17g}; relTol 0; maxIter {};", entry.entry,
                               name == fft.name ? direct_tolerance
                                                : settings.real("fluid." + problem + "_tolerance"),
                               most_iterations);
        names += (names.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw Failure(ExitCode::bad_input,
                  fmt::format("{} = \"{}\"; allowed are {}", key, name, names));
}

/// FFT is linked into turbidite-fluid; OpenFOAM's own programs find it with `libs
/// ("libturbiditeFFT.so");` in controlDict.
std::string solution(const Settings& settings) {
    return fmt::format("solvers\n{{\n    p {{ {} }}\n    U {{ {} }}\n}}\n",
                       solver(settings, "pressure", {fft, gamg, pcg}, 2000),
                       solver(settings, "viscous", {fft, pcg}, 1000));
}

std::string patch(const FluidDomain& domain, std::size_t side) {
    static const char* faces[] = {"(0 4 7 3)", "(1 2 6 5)", "(0 1 5 4)",
                                  "(3 7 6 2)", "(0 3 2 1)", "(4 5 6 7)"};
    const std::string& kind = domain.sides[side];
    std::string type = kind == "wall" ? "wall" : "patch";
    if (kind == "cyclic")  // partners: left-right, bottom-top, front-back
        type = fmt::format("cyclic; neighbourPatch {}", box_sides[opposite(side)].name);
    return fmt::format("    {} {{ type {}; faces ({}); }}\n", box_sides[side].name, type,
                       faces[side]);
}

/// blockMesh's expansion ratios along y: one section per row of a stretched mesh.
std::string grading_of_rows(const FluidDomain& domain) {
    if (!stretched(domain)) return "1";
    std::string sections = "(";
    for (std::size_t j = 0; j + 1 < domain.row_edges.size(); ++j)
        sections += fmt::format("({:.17g} 1 1)", domain.row_edges[j + 1] - domain.row_edges[j]);
    return sections + ")";
}

std::string block_mesh(const FluidDomain& domain) {
    std::string vertices;
    for (double z : {0.0, domain.size[2]})
        for (const auto& [x, y] : {std::pair{0.0, 0.0},
                                   {domain.size[0], 0.0},
                                   {domain.size[0], domain.size[1]},
                                   {0.0, domain.size[1]}})
            vertices += fmt::format("    ({:.17g} {:.17g} {:.17g})\n", x, y, z);
    std::string patches;
    for (std::size_t side = 0; side < side_count(domain.dimension); ++side)
        patches += patch(domain, side);
    if (domain.dimension == 2)
        patches += "    frontAndBack { type empty; faces ((0 3 2 1) (4 5 6 7)); }\n";
    return fmt::format(
        "scale 1;\nvertices\n(\n{});\n"
        "blocks ( hex (0 1 2 3 4 5 6 7) ({} {} {}) simpleGrading (1 {} 1) );\n"
        "edges ();\nboundary\n(\n{});\n",
        vertices, domain.cells[0], domain.cells[1], domain.cells[2], grading_of_rows(domain),
        patches);
}

/// The rank of every cell, in blockMesh's order: complete rows.
std::string rank_of_cells(const Settings& settings, const FluidDomain& domain) {
    const std::vector<int> first =
        first_layers(settings, domain.cells[1], static_cast<int>(settings.integer("fluid.ranks")));
    std::string text = fmt::format("{}\n(\n", domain.cells[0] * domain.cells[1] * domain.cells[2]);
    for (std::int64_t row = 0; row < domain.cells[1] * domain.cells[2]; ++row) {
        const auto above = std::upper_bound(first.begin(), first.end(), row % domain.cells[1]);
        const std::string rank = fmt::format("{} ", above - first.begin() - 1);
        for (int i = 0; i < domain.cells[0]; ++i) text += rank;
        text += '\n';
    }
    return text + ")\n";
}

/// Whether ranks have whole rows, each as many as the launcher says.
bool is_cut_by_rows(const Settings& settings) {
    return settings.text("fluid.decomposition") == "rows" && settings.integer("fluid.ranks") > 1;
}

/// `simple` sorts the cells by coordinates rotated by `delta`. The default is so large that columns
/// of more than a thousand cells would be split; it must only be non-zero.
std::string decomposition(const Settings& settings) {
    const std::int64_t ranks = settings.integer("fluid.ranks");
    const std::string& kind = settings.text("fluid.decomposition");
    if (kind != "rows" && kind != "columns")
        throw Failure(ExitCode::bad_input,
                      "fluid.decomposition = \"" + kind + "\"; allowed are rows, columns");
    if (is_cut_by_rows(settings))
        return fmt::format(
            "numberOfSubdomains {};\nmethod manual;\ncoeffs {{ dataFile \"cellDecomposition\"; "
            "}}\n",
            ranks);
    return fmt::format(
        "numberOfSubdomains {};\nmethod simple;\ncoeffs {{ n ({} 1 1); delta 1e-06; }}\n", ranks,
        ranks);
}

/// Conditions on the sides: `closed(side)` on walls and inflows, `at_free` on free sides.
template <class Closed>
std::string boundary_field(const FluidDomain& domain, Closed closed, const std::string& at_free) {
    std::string text = "boundaryField\n{\n";
    for (std::size_t side = 0; side < side_count(domain.dimension); ++side) {
        const std::string& kind = domain.sides[side];
        const std::string value = kind == "cyclic" ? "type cyclic;"
                                  : kind == "free" ? at_free
                                                   : closed(side);
        text += fmt::format("    {} {{ {} }}\n", box_sides[side].name, value);
    }
    return text + (domain.dimension == 2 ? "    frontAndBack { type empty; }\n}\n" : "}\n");
}

/// The mean velocity of the first window; the fluid program sets that of every window, with its
/// profile.
std::string side_velocity(const SideMotion& side, double step) {
    if (!side.motion) return "type noSlip;";
    const auto [x, y, z] = side.velocity(0.0, step);
    return fmt::format("type fixedValue; value uniform ({:.17g} {:.17g} {:.17g});", x, y, z);
}

std::string initial_velocity(const FluidDomain& domain, const Settings& settings) {
    const auto motions = side_motions(settings);
    const double step = run_values(settings).step;
    return "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (0 0 0);\n" +
           boundary_field(
               domain, [&](std::size_t side) { return side_velocity(motions[side], step); },
               "type zeroGradient;");
}

std::string initial_pressure(const FluidDomain& domain) {
    return "dimensions [0 2 -2 0 0 0 0];\ninternalField uniform 0;\n" +
           boundary_field(
               domain, [](int) { return "type zeroGradient;"; },
               "type fixedValue; value uniform 0;");
}

std::string transport_properties(const RunValues& run) {
    return fmt::format(
        "transportModel Newtonian;\nnu  [0 2 -1 0 0 0 0] {:.17g};\nrho [1 -3 0 0 0 0 0] {:.17g};\n",
        run.viscosity, run.fluid_density);
}

}  // namespace

void write_decomposition(const Settings& settings, const std::filesystem::path& directory) {
    write(directory, "system", "decomposeParDict", "dictionary", decomposition(settings));
    if (is_cut_by_rows(settings))
        write(directory, "constant", "cellDecomposition", "labelList",
              rank_of_cells(settings, fluid_domain(settings)));
}

void extend_fluid_case(const Settings& settings, const std::filesystem::path& directory) {
    const std::filesystem::path file = directory / "system" / "controlDict";
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    static const std::regex entry(R"((^|\n)(\s*endTime\s+)[^;]*;)");
    std::smatch old;
    if (!std::regex_search(text, old, entry))
        throw Failure(ExitCode::bad_input, file.string() + " has no entry endTime");
    const RunValues run = run_values(settings);
    const double end = run.step * static_cast<double>(run.windows);
    write_whole(file, [&](std::ostream& out) {
        out << old.prefix() << old[1] << old[2] << fmt::format("{:.17g};", end) << old.suffix();
    });
}

void write_fluid_case(const Settings& settings, const std::filesystem::path& directory) {
    const FluidDomain domain = fluid_domain(settings);
    const RunValues run = run_values(settings);
    write(directory, "system", "controlDict", "dictionary", control_dict(settings, run));
    write(directory, "system", "fvSchemes", "dictionary", schemes(settings, domain));
    write(directory, "system", "fvSolution", "dictionary", solution(settings));
    write(directory, "system", "blockMeshDict", "dictionary", block_mesh(domain));
    write_decomposition(settings, directory);
    write(directory, "constant", "transportProperties", "dictionary", transport_properties(run));
    write(directory, "0", "U", "volVectorField", initial_velocity(domain, settings));
    write(directory, "0", "p", "volScalarField", initial_pressure(domain));
    // ParaView's reader opens a case by an empty file of this name.
    std::ofstream(directory / "fluid.foam");
}

}  // namespace turbidite
