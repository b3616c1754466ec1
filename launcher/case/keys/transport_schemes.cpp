// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/keys/transport_schemes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "coupler/keys/key_value.hpp"
#include "coupler/keys/nearest_name.hpp"

namespace turbidite {
namespace {

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

/// The interpolation schemes of OpenFOAM 1912 that behave alike and take as many parameters.
struct LikeSchemes {
    SchemeKind kind;
    int words;
    const char* names;
};
constexpr LikeSchemes like_schemes[] = {
    {SchemeKind::biased, 0,
     "MUSCL MUSCLV QUICK QUICKV SuperBee SuperBeeV cubicUpwindFit filteredLinear "
     "filteredLinear2 filteredLinear2V filteredLinear3 filteredLinear3V "
     "linearPureUpwindFit quadraticLinearUpwindFit quadraticUpwindFit"},
    {SchemeKind::biased, 1, "LUST linearUpwind linearUpwindV"},
    {SchemeKind::by_field, 0,
     "CoBlended Phi blended cellCoBlended deferredCorrection fixedBlended limitWith "
     "limiterBlended localBlended localMax localMin outletStabilised skewCorrected "
     "weighted weightedFlux"},
    {SchemeKind::central, 0,
     "biLinearFit clippedLinear cubic downwind linear linearFit midPoint "
     "pointLinear quadraticFit quadraticLinearFit reverseLinear"},
    {SchemeKind::limited, 0,
     "Minmod MinmodV OSPRE OSPREV SFCD SFCDV UMIST UMISTV upwind vanAlbada "
     "vanAlbadaV vanLeer vanLeerV"},
    {SchemeKind::limited, 1,
     "Gamma GammaV limitedCubic limitedCubicV limitedLinear limitedLinearV"},
};

std::vector<TransportScheme> all_schemes() {
    std::vector<TransportScheme> list;
    for (const auto& [kind, words, names] : like_schemes)
        for (const std::string& name : words_of(names)) list.push_back({name, kind, words});
    std::sort(list.begin(), list.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return list;
}

std::string with_default(const TransportScheme& scheme) {
    if (scheme.words == 0) return fmt::format("Gauss {}", scheme.name);
    const bool needs_gradient = scheme.kind == SchemeKind::biased;
    return fmt::format("Gauss {} {}", scheme.name, needs_gradient ? "grad(U)" : "1");
}

/// The scheme of that name, otherwise the nearest one that needs nothing which this list lacks.
const TransportScheme& nearest_scheme(const std::string& name) {
    const std::vector<TransportScheme>& list = transport_scheme_list();
    const auto called = [&list](const std::string& wanted) {
        return std::find_if(list.begin(), list.end(),
                            [&](const TransportScheme& scheme) { return scheme.name == wanted; });
    };
    if (const auto own = called(name); own != list.end()) return *own;
    std::vector<std::string> names;
    for (const TransportScheme& scheme : list)
        if (scheme.kind != SchemeKind::by_field) names.push_back(scheme.name);
    return *called(nearest_name(name, names));
}

/// The parameter of a limiter is a number from 0 to 1.
bool is_limiter(const std::string& word) {
    const std::optional<double> k = parse_real(word);
    return k && *k >= 0.0 && *k <= 1.0;
}

/// What is wrong with the words behind the name of a scheme; empty if nothing is.
std::string fault_of(const TransportScheme& scheme, const std::vector<std::string>& parameters) {
    const auto given = static_cast<int>(parameters.size());
    if (given < scheme.words) return fmt::format("{} needs a parameter.", scheme.name);
    const bool one = scheme.words == 1;
    if (scheme.kind == SchemeKind::limited && one && !is_limiter(parameters[0]))
        return fmt::format("The parameter of {} is a number from 0 to 1, not {}.", scheme.name,
                           parameters[0]);
    if (scheme.kind == SchemeKind::biased && one && parameters[0] != "grad(U)")
        return fmt::format("The parameter of {} is grad(U), not {}.", scheme.name, parameters[0]);
    // Of some others the list does not say how many they read.
    const bool counted =
        one || scheme.kind == SchemeKind::central || scheme.kind == SchemeKind::limited;
    if (counted && given > scheme.words)
        return fmt::format("{} takes {}, so \"{}\" means nothing.", scheme.name,
                           one ? "one parameter" : "no parameter", parameters[scheme.words]);
    return "";
}

}  // namespace

const std::vector<TransportScheme>& transport_scheme_list() {
    static const std::vector<TransportScheme> list = all_schemes();
    return list;
}

SchemeChoice read_transport_scheme(const std::string& text) {
    std::vector<std::string> words = words_of(text);
    if (!words.empty() && words[0] == "bounded") words.erase(words.begin());
    const bool has_gauss = !words.empty() && words[0] == "Gauss";
    // The scheme that is meant is the next word where the first one is only written otherwise.
    if (has_gauss || (words.size() > 1 && words[0] == "gauss")) words.erase(words.begin());
    const std::string name = words.empty() ? "limitedLinearV" : words[0];
    const TransportScheme& nearest = nearest_scheme(name);
    const std::string remedy = fmt::format("Use {}.", with_default(nearest));
    if (!has_gauss) return {nullptr, "OpenFOAM's convection schemes begin with Gauss.", remedy};
    if (words.empty()) return {nullptr, "Gauss is followed by an interpolation scheme.", remedy};
    if (name != nearest.name)
        return {nullptr, fmt::format("OpenFOAM 1912 has no scheme {}.", name), remedy};
    const std::string fault = fault_of(nearest, {words.begin() + 1, words.end()});
    if (!fault.empty()) return {nullptr, fault, remedy};
    return {&nearest, {}, {}};
}

bool is_scheme_on_rows(const std::string& text) {
    const std::vector<std::string> words = words_of(text);
    constexpr const char* known[] = {"limitedLinearV", "linear", "LUST", "linearUpwind"};
    return words.size() > 1 && words[0] == "Gauss" &&
           std::find(std::begin(known), std::end(known), words[1]) != std::end(known);
}

}  // namespace turbidite
