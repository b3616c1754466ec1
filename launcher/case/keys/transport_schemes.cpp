// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/keys/transport_schemes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "coupler/keys/nearest_name.hpp"

namespace turbidite {
namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

std::string with_default(const TransportScheme& scheme) {
    if (scheme.words == 0) return fmt::format("Gauss {}", scheme.name);
    const bool needs_gradient = scheme.kind == SchemeKind::biased;
    return fmt::format("Gauss {} {}", scheme.name, needs_gradient ? "grad(U)" : "1");
}

const TransportScheme& nearest_scheme(const std::string& name) {
    std::vector<std::string> names;
    for (const TransportScheme& scheme : transport_scheme_list()) names.push_back(scheme.name);
    const auto at = std::find(names.begin(), names.end(), nearest_name(name, names));
    return transport_scheme_list()[at - names.begin()];
}

}  // namespace

const std::vector<TransportScheme>& transport_scheme_list() {
    static const std::vector<TransportScheme> list = {
        {"CoBlended", SchemeKind::by_field},
        {"Gamma", SchemeKind::limited, 1},
        {"GammaV", SchemeKind::limited, 1},
        {"LUST", SchemeKind::biased, 1},
        {"MUSCL", SchemeKind::biased},
        {"MUSCLV", SchemeKind::biased},
        {"Minmod", SchemeKind::limited},
        {"MinmodV", SchemeKind::limited},
        {"OSPRE", SchemeKind::limited},
        {"OSPREV", SchemeKind::limited},
        {"Phi", SchemeKind::by_field},
        {"QUICK", SchemeKind::biased},
        {"QUICKV", SchemeKind::biased},
        {"SFCD", SchemeKind::limited},
        {"SFCDV", SchemeKind::limited},
        {"SuperBee", SchemeKind::biased},
        {"SuperBeeV", SchemeKind::biased},
        {"UMIST", SchemeKind::limited},
        {"UMISTV", SchemeKind::limited},
        {"biLinearFit", SchemeKind::central},
        {"blended", SchemeKind::by_field},
        {"cellCoBlended", SchemeKind::by_field},
        {"clippedLinear", SchemeKind::central},
        {"cubic", SchemeKind::central},
        {"cubicUpwindFit", SchemeKind::biased},
        {"deferredCorrection", SchemeKind::by_field},
        {"downwind", SchemeKind::central},
        {"filteredLinear", SchemeKind::biased},
        {"filteredLinear2", SchemeKind::biased},
        {"filteredLinear2V", SchemeKind::biased},
        {"filteredLinear3", SchemeKind::biased},
        {"filteredLinear3V", SchemeKind::biased},
        {"fixedBlended", SchemeKind::by_field},
        {"limitWith", SchemeKind::by_field},
        {"limitedCubic", SchemeKind::limited, 1},
        {"limitedCubicV", SchemeKind::limited, 1},
        {"limitedLinear", SchemeKind::limited, 1},
        {"limitedLinearV", SchemeKind::limited, 1},
        {"limiterBlended", SchemeKind::by_field},
        {"linear", SchemeKind::central},
        {"linearFit", SchemeKind::central},
        {"linearPureUpwindFit", SchemeKind::biased},
        {"linearUpwind", SchemeKind::biased, 1},
        {"linearUpwindV", SchemeKind::biased, 1},
        {"localBlended", SchemeKind::by_field},
        {"localMax", SchemeKind::by_field},
        {"localMin", SchemeKind::by_field},
        {"midPoint", SchemeKind::central},
        {"outletStabilised", SchemeKind::by_field},
        {"pointLinear", SchemeKind::central},
        {"quadraticFit", SchemeKind::central},
        {"quadraticLinearFit", SchemeKind::central},
        {"quadraticLinearUpwindFit", SchemeKind::biased},
        {"quadraticUpwindFit", SchemeKind::biased},
        {"reverseLinear", SchemeKind::central},
        {"skewCorrected", SchemeKind::by_field},
        {"upwind", SchemeKind::limited},
        {"vanAlbada", SchemeKind::limited},
        {"vanAlbadaV", SchemeKind::limited},
        {"vanLeer", SchemeKind::limited},
        {"vanLeerV", SchemeKind::limited},
        {"weighted", SchemeKind::by_field},
        {"weightedFlux", SchemeKind::by_field},
    };
    return list;
}

SchemeChoice read_transport_scheme(const std::string& text) {
    std::vector<std::string> words = words_of(text);
    if (!words.empty() && words[0] == "bounded") words.erase(words.begin());
    const bool has_gauss = !words.empty() && words[0] == "Gauss";
    if (has_gauss) words.erase(words.begin());
    const std::string name = words.empty() ? "limitedLinearV" : words[0];
    const TransportScheme& nearest = nearest_scheme(name);
    const std::string remedy = fmt::format("Use {}.", with_default(nearest));
    if (!has_gauss) return {nullptr, "OpenFOAM's convection schemes begin with Gauss.", remedy};
    if (words.empty()) return {nullptr, "Gauss is followed by an interpolation scheme.", remedy};
    if (name != nearest.name)
        return {nullptr, fmt::format("OpenFOAM 1912 has no scheme {}.", name), remedy};
    if (static_cast<int>(words.size()) <= nearest.words)
        return {nullptr, fmt::format("{} needs a parameter.", name), remedy};
    return {&nearest, {}, {}};
}

}  // namespace turbidite
