// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/foam_solver/foam_box.hpp"

#include <iterator>
#include <sstream>
#include <stdexcept>

namespace turbidite {
namespace {

constexpr const char* names[] = {"left", "right", "bottom", "top"};
constexpr const char* opposite[] = {"right", "left", "top", "bottom"};

std::string header(const std::string& type, const std::string& object) {
    return "FoamFile { version 2.0; format ascii; class " + type + "; object " + object + "; }\n";
}

int vertex(int i, int j, int k) {
    return i + 4 * j + 16 * k;
}

std::string list(std::initializer_list<int> numbers) {
    std::string text = "(";
    for (int number : numbers) text += std::to_string(number) + " ";
    return text + ")";
}

/// The face of a side in block `third` of its three blocks.
std::string face(int side, int third) {
    const int at = side % 2 == 0 ? 0 : 3, a = third, b = third + 1;
    if (side < 2)
        return list({vertex(at, a, 0), vertex(at, b, 0), vertex(at, b, 1), vertex(at, a, 1)});
    return list({vertex(a, at, 0), vertex(b, at, 0), vertex(b, at, 1), vertex(a, at, 1)});
}

std::string patch(const FoamBox& box, int side) {
    std::string text = std::string("    ") + names[side] + " { type " + box.patches[side] + "; ";
    if (box.patches[side] == "cyclic")
        text += std::string("neighbourPatch ") + opposite[side] + "; ";
    const bool own = side == 0 && !box.lower_left.empty();
    text += "faces (" + (own ? "" : face(side, 0)) + face(side, 1) + face(side, 2) + "); }\n";
    if (own) text += "    lowerLeft { type patch; faces (" + face(side, 0) + "); }\n";
    return text;
}

std::string mesh_of(const FoamBox& box) {
    std::ostringstream text;
    text.precision(17);
    text << header("dictionary", "blockMeshDict") << "vertices\n(\n";
    for (double z : {0.0, 0.1})
        for (double y : box.y)
            for (double x : box.x) text << "    (" << x << " " << y << " " << z << ")\n";
    text << ");\nblocks\n(\n";
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
            if (box.hole && i == 1 && j == 1) continue;
            const int v = vertex(i, j, 0);
            text << "    hex " << list({v, v + 1, v + 5, v + 4, v + 16, v + 17, v + 21, v + 20})
                 << " (" << box.cells[0] << " " << box.cells[1] << " " << box.layers
                 << ") simpleGrading (1 1 1)\n";
        }
    text << ");\nboundary\n(\n";
    for (int side = 0; side < 4; ++side) text << patch(box, side);
    text << "    frontAndBack { type " << (box.layers == 1 ? "empty" : "patch") << "; faces (";
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                if (box.hole && i == 1 && j == 1) continue;
                const int v = vertex(i, j, k);
                text << list({v, v + 1, v + 5, v + 4});
            }
    text << "); }\n);\ndefaultPatch { name hole; type patch; }\n";
    return text.str();
}

std::string control_of(const FoamBox& box, double step, double end) {
    std::ostringstream text;
    text << header("dictionary", "controlDict")
         << "startFrom startTime; startTime 0; stopAt endTime; endTime " << end << "; deltaT "
         << step << ";\nwriteControl timeStep; writeInterval " << static_cast<int>(end / step + 0.5)
         << "; writeFormat ascii; writePrecision 16; timePrecision 6;\n"
         << box.control << "\n";
    return text.str();
}

std::string schemes_of(const FoamBox& box) {
    return header("dictionary", "fvSchemes") + "ddtSchemes { default " + box.ddt +
           "; }\ngradSchemes { default Gauss linear; }\ndivSchemes { default Gauss linear; }\n"
           "laplacianSchemes { default Gauss linear orthogonal; }\n"
           "interpolationSchemes { default linear; }\nsnGradSchemes { default orthogonal; }\n";
}

std::string boundary_of(const FoamBox& box, const Sides& conditions) {
    std::string text = "boundaryField\n{\n";
    for (int side = 0; side < 4; ++side)
        text += std::string("    ") + names[side] + " { " +
                (box.patches[side] == "cyclic" ? "type cyclic;" : conditions[side]) + " }\n";
    if (!box.lower_left.empty()) text += "    lowerLeft { " + box.lower_left + " }\n";
    if (box.hole) text += "    hole { type zeroGradient; }\n";
    return text + "    frontAndBack { type " + (box.layers == 1 ? "empty" : "zeroGradient") +
           "; }\n}\n";
}

}  // namespace

void write_box(const ScratchFolder& folder, const FoamBox& box, double step, double end) {
    folder.write("system/blockMeshDict", mesh_of(box));
    folder.write("system/controlDict", control_of(box, step, end));
    folder.write("system/fvSchemes", schemes_of(box));
    folder.write("system/fvSolution", header("dictionary", "fvSolution") + box.solution);
    folder.write("constant/transportProperties",
                 header("dictionary", "transportProperties") +
                     "DT [0 2 -1 0 0 0 0] 0.3; nu [0 2 -1 0 0 0 0] 0.01;\n");
}

void write_field(const ScratchFolder& folder, const FoamBox& box, const std::string& name,
                 const std::string& dimensions, const Sides& conditions,
                 const std::vector<double>& values) {
    std::ostringstream text;
    text.precision(17);
    text << header("volScalarField", name) << "dimensions " << dimensions << ";\ninternalField ";
    if (values.empty()) text << "uniform 0";
    if (!values.empty()) text << "nonuniform List<scalar> " << values.size() << " (";
    for (double value : values) text << value << " ";
    if (!values.empty()) text << ")";
    text << ";\n" << boundary_of(box, conditions);
    folder.write("0/" + name, text.str());
}

void write_vector_field(const ScratchFolder& folder, const FoamBox& box, const std::string& name,
                        const Sides& conditions) {
    folder.write("0/" + name, header("volVectorField", name) +
                                  "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (0 0 0);\n" +
                                  boundary_of(box, conditions));
}

void write_decomposition(const ScratchFolder& folder, const std::array<int, 2>& ranks) {
    const std::string n = std::to_string(ranks[0]) + " " + std::to_string(ranks[1]) + " 1";
    folder.write("system/decomposeParDict",
                 header("dictionary", "decomposeParDict") + "numberOfSubdomains " +
                     std::to_string(ranks[0] * ranks[1]) + ";\nmethod simple;\n" +
                     "simpleCoeffs { n (" + n + "); delta 0.000001; }\n");
}

std::vector<double> read_field(const std::filesystem::path& file) {
    std::ifstream input(file);
    std::string text{std::istreambuf_iterator<char>(input), {}};
    const std::size_t from = text.find('(', text.find("nonuniform"));
    const std::size_t to = text.find("boundaryField");
    if (from == std::string::npos || to == std::string::npos)
        throw std::runtime_error(file.string() + " holds no field of different values");
    for (char& letter : text)
        if (letter == '(' || letter == ')' || letter == ';') letter = ' ';
    std::istringstream numbers(text.substr(from, to - from));
    return {std::istream_iterator<double>(numbers), {}};
}

}  // namespace turbidite
