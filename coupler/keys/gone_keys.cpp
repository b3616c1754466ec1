// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/gone_keys.hpp"

namespace turbidite {
namespace {

struct GoneKey {
    const char* name;
    const char* why;
};

constexpr GoneKey gone_keys[] = {
    {"contact.theta",
     "It changed nothing: grains are where contacts are detected, and there they move by dt U "
     "whatever theta is."},
};

}  // namespace

std::string why_gone(const std::string& key) {
    for (const GoneKey& gone : gone_keys)
        if (key == gone.name) return gone.why;
    return "";
}

}  // namespace turbidite
