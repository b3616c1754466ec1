// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace turbidite {
namespace {

std::string last_part(const std::string& name) {
    return name.substr(name.rfind('.') + 1);
}

// A name without its group is compared with the last parts; this counts as one edit.
std::size_t distance(const std::string& name, const std::string& known) {
    const std::size_t whole = edit_distance(name, known);
    if (name.find('.') != std::string::npos) return whole;
    return std::min(whole, edit_distance(name, last_part(known)) + 1);
}

bool ends_word(const std::string& name, std::size_t at) {
    return at == name.size() || name[at] == '-' || name[at] == '_' || name[at] == '.';
}

/// `known` has `name` as a whole word or as several of them.
bool has_word(const std::string& known, const std::string& name) {
    if (name.empty()) return false;
    for (auto at = known.find(name); at != std::string::npos; at = known.find(name, at + 1))
        if ((at == 0 || ends_word(known, at - 1)) && ends_word(known, at + name.size()))
            return true;
    return false;
}

}  // namespace

std::size_t edit_distance(const std::string& from, const std::string& to) {
    const std::size_t n = to.size();
    std::vector<std::size_t> before(n + 1), last(n + 1), now(n + 1);
    for (std::size_t j = 0; j <= n; ++j) last[j] = j;
    for (std::size_t i = 1; i <= from.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= n; ++j) {
            const std::size_t replace = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, replace});
            // Two neighbours in the wrong order are one error, not two.
            if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
                now[j] = std::min(now[j], before[j - 2] + 1);
        }
        // Three rows of the table are enough: this one, the last and, for the swap, the one before.
        before.swap(last);
        last.swap(now);
    }
    return last[n];
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
    std::string best;
    std::size_t smallest = std::numeric_limits<std::size_t>::max();
    for (const std::string& candidate : known) {
        const std::size_t edits = distance(name, candidate);
        if (edits >= smallest) continue;
        smallest = edits;
        best = candidate;
    }
    return best;
}

std::vector<std::string> resembling(const std::string& name,
                                    const std::vector<std::string>& known) {
    constexpr std::size_t most = 3, typing_error = 2;
    const std::string nearest = nearest_name(name, known);
    if (distance(name, nearest) <= typing_error) return {nearest};
    std::vector<std::string> found;
    for (const std::string& candidate : known)
        if (found.size() < most && has_word(candidate, name)) found.push_back(candidate);
    // A third of the letters may be wrong.
    if (found.empty() && 3 * distance(name, nearest) <= name.size()) return {nearest};
    return found;
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& known,
                         const std::string& rest) {
    const std::vector<std::string> names = resembling(name, known);
    if (names.empty()) return rest;
    return fmt::format("Did you mean {}?{}{}", fmt::join(names, " or "), rest.empty() ? "" : " ",
                       rest);
}

std::vector<std::string> nearest_names(const std::string& name,
                                       const std::vector<std::string>& known) {
    const std::vector<std::string> names = resembling(name, known);
    return names.empty() ? std::vector<std::string>{nearest_name(name, known)} : names;
}

}  // namespace turbidite
