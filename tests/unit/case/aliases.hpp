// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Aliases of aliases: some hundred bytes of YAML whose a5 stands for a hundred thousand values. Of
// ten million a reader without the limit had 3 GB and no end after five minutes.
#pragma once

#include <string>

namespace turbidite {

inline std::string powers_of_ten() {
    std::string text = "a0: &a0 {k: 1}\n";
    for (int n = 1; n <= 5; ++n) {
        const std::string name = "a" + std::to_string(n), of = "*a" + std::to_string(n - 1);
        text += name + ": &" + name + " {";
        for (char key = 'a'; key < 'k'; ++key) text += std::string(1, key) + ": " + of + ", ";
        text += "}\n";
    }
    return text;
}

}  // namespace turbidite
