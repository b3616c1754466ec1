// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/version.hpp"

#include "commit.hpp"

namespace turbidite {

std::string version() {
    return TURBIDITE_VERSION;
}

std::string commit() {
    return TURBIDITE_COMMIT;
}

}  // namespace turbidite
