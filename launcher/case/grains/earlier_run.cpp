// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/earlier_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/failure.hpp"
#include "launcher/case/files/file_names.hpp"
#include "launcher/case/files/run_folder.hpp"

namespace turbidite {
namespace {

constexpr double same_time = 1e-6;  // of the series' times, which have nine digits

std::string whole_text(const std::filesystem::path& file) {
    std::ifstream input(file);
    if (!input)
        throw start_refused(file.string() + " cannot be read",
                            "Give the folder of a run that has written grains.");
    return {std::istreambuf_iterator<char>(input), {}};
}

struct Output {
    double time = 0.0;  ///< run units
    std::string file;
};

/// The grains of every output, in order.
std::vector<Output> outputs_of(const std::filesystem::path& series) {
    static const std::regex entry(R"rx(timestep="([^"]*)" part="0" file="([^"]*)")rx");
    const std::string text = whole_text(series);
    std::vector<Output> outputs;
    for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at)
        outputs.push_back({parse_real((*at)[1]).value_or(std::nan("")), (*at)[2]});
    if (outputs.empty())
        throw start_refused(series.string() + " contains no output",
                            "Give the folder of a run that has written grains.");
    return outputs;
}

const Output& output_at(const std::vector<Output>& outputs, const EarlierRun& run,
                        double time_scale) {
    if (!run.time) return outputs.back();
    // [t_c] of the earlier run, whose series has its own units.
    const double wanted = *run.time * time_scale;
    const auto distance = [&](const Output& o) { return std::abs(o.time - wanted); };
    const Output& nearest = *std::min_element(
        outputs.begin(), outputs.end(),
        [&](const Output& a, const Output& b) { return distance(a) < distance(b); });
    if (distance(nearest) <= same_time * std::max(time_scale, std::abs(wanted))) return nearest;
    throw start_refused(
        fmt::format("{} has no output at {:.6g} t_c", run.folder.string(), *run.time),
        fmt::format("There are {} from {:.6g} to {:.6g} t_c; the nearest is @{:.6g}.",
                    outputs.size(), outputs.front().time / time_scale,
                    outputs.back().time / time_scale, nearest.time / time_scale));
}

/// The numbers of a DataArray of a VTK file in text form.
template <class Number = double>
std::vector<Number> numbers_of(const std::string& text, const std::string& name,
                               const std::filesystem::path& file) {
    const auto label = text.find("Name=\"" + name + "\"");
    const auto begin = label == std::string::npos ? label : text.find('>', label);
    const auto end = begin == std::string::npos ? begin : text.find('<', begin);
    if (end == std::string::npos)
        throw start_refused(fmt::format("{} has no {}", file.string(), name),
                            "It must be a grains file that this version wrote.");
    std::istringstream in(text.substr(begin + 1, end - begin - 1));
    std::vector<Number> numbers;
    for (Number number; in >> number;) numbers.push_back(number);
    return numbers;
}

std::vector<double> column(const std::string& text, const std::string& name, std::size_t width,
                           std::size_t count, const std::filesystem::path& file) {
    std::vector<double> numbers = numbers_of(text, name, file);
    if (numbers.size() == width * count) return numbers;
    throw start_refused(fmt::format("{} has {} numbers of {} for {} grains", file.string(),
                                    numbers.size(), name, count),
                        "It must be a grains file that this version wrote.");
}

bool same_outline(const ShapeRecord& a, const ShapeRecord& b) {
    if (a.kind != b.kind || a.vertices.size() != b.vertices.size()) return false;
    for (std::size_t i = 0; i < a.vertices.size(); ++i)
        if (std::abs(a.vertices[i] - b.vertices[i]) > 1e-9) return false;
    return true;
}

std::int32_t form_of(const ShapeRecord& shape, const GrainForms& forms) {
    for (std::size_t i = 0; i < forms.forms.size(); ++i)
        if (same_outline(shape, forms.forms[i].record)) return static_cast<std::int32_t>(i);
    throw start_refused(
        fmt::format("the earlier run has grains of shape {}{}, which the case does not "
                    "have",
                    shape.kind, shape.kind == "polygon" ? " of other vertices" : ""),
        "Give the case the same grains.shape and grains.vertices.");
}

std::int32_t material_of(const std::string& name, const std::vector<std::string>& materials) {
    const auto at = std::find(materials.begin(), materials.end(), name);
    if (at != materials.end()) return static_cast<std::int32_t>(at - materials.begin());
    throw start_refused(
        fmt::format("the earlier run has grains of material {}, which the case does not "
                    "have",
                    name),
        "Define it below contact.materials.");
}

/// To the digits of the series it is one.
Quaternion unit(Quaternion q) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& part : q) part /= length;
    return q;
}

}  // namespace

Failure start_refused(const std::string& fault, const std::string& remedy) {
    return Failure(ExitCode::bad_input, fmt::format("--from: {}\n  {}\nNothing was started. Exit "
                                                    "code 2.",
                                                    fault, remedy));
}

EarlierRun parse_earlier_run(const std::string& text) {
    EarlierRun run{text, std::nullopt};
    const auto at = text.rfind('@');
    if (at != std::string::npos && !is_there(text)) {
        run.folder = text.substr(0, at);
        run.time = parse_real(text.substr(at + 1));
        if (!run.time || !std::isfinite(*run.time))
            throw start_refused(fmt::format("\"{}\" is not a time", text.substr(at + 1)),
                                "Write DIR@time with the time in t_c, for example runs/a@2.5.");
    }
    if (!is_there(RunFolder{run.folder}.resolved_case()))
        throw start_refused(run.folder.string() + " is not a run folder: it has no case.yaml",
                            "Give a folder written by `turbidite run`.");
    return run;
}

EarlierGrains read_earlier_grains(const EarlierRun& run, const EarlierCase& earlier,
                                  const GrainForms& forms,
                                  const std::vector<std::string>& materials) {
    const RunFolder folder{run.folder};
    const std::vector<Output> outputs = outputs_of(folder.grains_series());
    const Output& output = output_at(outputs, run, earlier.scales.time);
    const std::filesystem::path file = folder.grains() / output.file;
    const std::string text = whole_text(file);
    const double d = earlier.scales.diameter, u = earlier.scales.velocity;
    // A double would change ids above 2^53.
    const std::vector<GrainId> id = numbers_of<GrainId>(text, "id", file);
    const std::size_t n = id.size();
    const auto all = [&](const char* name, std::size_t width) {
        return column(text, name, width, n, file);
    };
    const auto position = all("position", 3), velocity = all("velocity", 3);
    const auto turn = all("orientation", 4), spin = all("angular_velocity", 3);
    const auto radius = all("radius", 1), density = all("density", 1), shape = all("shape", 1);
    const auto material = all("material", 1), prescribed = all("prescribed", 1);
    EarlierGrains result{{}, file.string(), output.time / earlier.scales.time};
    const bool space = forms.dimension == 3;
    for (std::size_t i = 0; i < n; ++i) {
        result.grains.push_back(
            {.id = id[i],
             // Back to D, u_c and 1/t_c of the earlier run: the case may have other units.
             .x = position[3 * i] / d,
             .y = position[3 * i + 1] / d,
             .radius = radius[i] / d,
             .shape = form_of(earlier.shapes.at(static_cast<std::size_t>(shape[i])), forms),
             // Of q = (cos a/2, 0, 0, sin a/2).
             .angle = 2.0 * std::atan2(turn[4 * i + 3], turn[4 * i]),
             .vx = velocity[3 * i] / u,
             .vy = velocity[3 * i + 1] / u,
             .spin = spin[3 * i + 2] * earlier.scales.time,
             // Over that of the fluid, as in a grains file.
             .density = density[i] / earlier.scales.fluid_density,
             .material = material_of(earlier.materials.at(static_cast<std::size_t>(material[i])),
                                     materials),
             .prescribed = prescribed[i] != 0.0});
        if (!space) continue;
        PlacedGrain& grain = result.grains.back();
        grain.angle = 0.0;
        grain.z = position[3 * i + 2] / d;
        grain.vz = velocity[3 * i + 2] / u;
        grain.wx = spin[3 * i] * earlier.scales.time;
        grain.wy = spin[3 * i + 1] * earlier.scales.time;
        grain.turn = unit({turn[4 * i], turn[4 * i + 1], turn[4 * i + 2], turn[4 * i + 3]});
    }
    return result;
}

}  // namespace turbidite
