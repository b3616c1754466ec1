// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/slices.hpp"

#include <charconv>
#include <regex>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"

namespace turbidite {
namespace {

/// Between two planes stands a comma or a space.
const std::regex one_plane(R"((?:^\s*|\s*[,\s]\s*)([xyz])\s*=\s*([-+.\deE]+))");

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
    // One after the other: an expression for the whole list would recurse once per plane.
    std::size_t read = 0;
    const auto next = std::regex_constants::match_continuous;
    for (std::sregex_iterator at(text.begin(), text.end(), one_plane, next), end; at != end; ++at) {
        const std::optional<double> place = number((*at)[2]);
        if (!place) return std::nullopt;
        planes.push_back({static_cast<std::size_t>((*at)[1].str()[0] - 'x'), *place});
        read = static_cast<std::size_t>(at->position() + at->length());
    }
    const bool is_whole = text.find_first_not_of(" \t\r\n", read) == std::string::npos;
    return is_whole && !planes.empty() ? std::optional(planes) : std::nullopt;
}

std::vector<SlicePlane> slices_of(const Settings& settings) {
    if (!in_space(settings) || !settings.flag("fluid.enabled")) return {};
    const std::string& text = settings.text("output.slices");
    if (text != "auto") return read_slices(text).value();
    return {{2, 0.5 * real_list("domain.size", settings.text("domain.size")).at(2)}};
}

}  // namespace turbidite
