// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/host_name.hpp"

#include <unistd.h>

namespace turbidite {

std::string host_name() {
    char name[256] = {};
    ::gethostname(name, sizeof name - 1);  // the last byte stays 0: a long name is cut, not open
    return name;
}

}  // namespace turbidite
