// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/slices.hpp"

#include <charconv>
#include <regex>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"

namespace turbidite {
namespace {

const std::regex whole_list(
    R"(\s*([xyz]\s*=\s*[-+.\deE]+)(\s*[,\s]\s*[xyz]\s*=\s*[-+.\deE]+)*\s*)");
const std::regex one_plane(R"(([xyz])\s*=\s*([-+.\deE]+))");

std::optional<double> number(const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end) return std::nullopt;
    return value;
}

}  // namespace

std::optional<std::vector<SlicePlane>> read_slices(const std::string& text) {
    std::vector<SlicePlane> planes;
    if (text == "none") return planes;
    if (!std::regex_match(text, whole_list)) return std::nullopt;
    for (std::sregex_iterator at(text.begin(), text.end(), one_plane), end; at != end; ++at) {
        const std::optional<double> place = number((*at)[2]);
        if (!place) return std::nullopt;
        planes.push_back({static_cast<std::size_t>((*at)[1].str()[0] - 'x'), *place});
    }
    return planes;
}

std::vector<SlicePlane> slices_of(const Settings& settings) {
    if (!in_space(settings) || !settings.flag("fluid.enabled")) return {};
    const std::string& text = settings.text("output.slices");
    if (text != "auto") return read_slices(text).value();
    return {{2, 0.5 * real_list("domain.size", settings.text("domain.size")).at(2)}};
}

}  // namespace turbidite
