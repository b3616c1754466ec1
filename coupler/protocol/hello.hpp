// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a participant says of itself before anything else, and what two such statements must agree
// on. All mismatches are reported together. Valid C++17.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace turbidite {

/// Major versions must be equal; of the minor ones the smaller rules, down to `oldest_minor`.
inline constexpr std::int32_t protocol_major = 1;
inline constexpr std::int32_t protocol_minor = 4;

/// The oldest minor version that is understood: since then the coupler tells the order of a window,
/// and `accept` ends it under every scheme with a fluid.
inline constexpr std::int32_t oldest_minor = 4;

enum class Role : std::int32_t { coupler = 0, fluid = 1, grains = 2 };

/// "coupler", "fluid", "grains".
const char* role_name(Role role);

/// What an adapter can do. Names that may be missing are checked only when the case needs them.
struct Capabilities {
    bool saves_state = false;             ///< can write and read a checkpoint
    bool restores_within_window = false;  ///< can repeat a window (sub-iterated schemes)
    bool serialises_state = false;        ///< hands its state over as bytes
    bool native_substeps = false;         ///< moves grains by its own smaller steps
    bool effective_inertia = false;       ///< gives or takes a FreeResponse
    std::vector<std::string> shapes;      ///< kinds of shapes/shape_list
    std::vector<std::string> contact_laws;
};

struct Hello {
    std::int32_t protocol_major = turbidite::protocol_major;
    std::int32_t protocol_minor = turbidite::protocol_minor;
    Role role = Role::coupler;
    std::string adapter;          ///< "yade-nscd"
    std::string adapter_version;  ///< the project's version
    std::string host_code;        ///< "YADE 2023.02a"
    std::int32_t dimension = 2;
    std::int32_t rank = 0;
    std::int32_t ranks = 1;
    std::string host;  ///< machine name
    std::int64_t pid = 0;
    std::string log_file;
    std::string case_hash;  ///< of the run folder it was started on; empty: takes any
    Capabilities capabilities;
};

/// What the case asks of a participant.
struct Expectation {
    Role role = Role::grains;
    std::string adapter;  ///< empty: any
    std::int32_t dimension = 2;
    std::int32_t ranks = 1;
    std::string case_hash;
    std::string scheme;              ///< run.scheme, for sentences
    bool effective_inertia = false;  ///< the scheme's order has a FreeResponse in it
    std::vector<std::string> shapes;
};

/// Every disagreement as one sentence; empty when all is well.
std::vector<std::string> mismatches(const Hello& hello, const Expectation& expected);

}  // namespace turbidite
