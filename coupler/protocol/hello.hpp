// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// What a participant reports about itself first of all, and the conditions for compatibility. All
/// mismatches are reported together. Valid C++17.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace turbidite {

/// Major versions must be equal; the smaller of the two minor versions applies, down to
/// `oldest_minor`.
inline constexpr std::int32_t protocol_major = 1;
/// See protocol_major.
inline constexpr std::int32_t protocol_minor = 10;

/// The oldest supported minor version: since then a ContactReport has the contact violation.
inline constexpr std::int32_t oldest_minor = 8;

/// The programs of a job.
enum class Role : std::int32_t { coupler = 0, fluid = 1, grains = 2 };

/// "coupler", "fluid", "grains".
const char* role_name(Role role);

/// Capabilities of an adapter. They are checked only when the case needs them.
struct Capabilities {
    bool saves_state = false;             ///< can write and read a checkpoint
    bool restores_within_window = false;  ///< can repeat a window (sub-iterated schemes)
    bool serialises_state = false;        ///< provides its state as bytes
    bool native_substeps = false;         ///< moves grains in smaller steps of its own
    bool effective_inertia = false;       ///< sends or receives a FreeResponse
    /// Kinds of shapes it knows: `disc`, `triangle`, `polygon`, in space `sphere`. A case with
    /// others is refused.
    std::vector<std::string> shapes;
    std::vector<std::string> contact_laws;  ///< beyond Coulomb friction; not checked
};

/// grains.adapter of a program of the user's own, which has any name.
inline constexpr const char* users_program = "external";

/// Hello::dimension of a program that plays in the plane and in space.
inline constexpr std::int32_t both_dimensions = 0;

/// The first message of every rank. `describe` of an adapter gives adapter, adapter_version,
/// host_code, dimension and capabilities; the library fills in the rest.
struct Hello {
    std::int32_t protocol_major = turbidite::protocol_major;
    std::int32_t protocol_minor = turbidite::protocol_minor;
    Role role = Role::coupler;
    std::string adapter;          ///< name of the program, "yade-nscd"
    std::string adapter_version;  ///< its own
    std::string host_code;        ///< "YADE 2023.02a"
    std::int32_t dimension = 2;   ///< 2, 3, or both_dimensions
    std::int32_t rank = 0;        ///< among those of the program
    std::int32_t ranks = 1;       ///< of the program
    std::string host;             ///< machine name
    std::int64_t pid = 0;
    std::string log_file;
    std::string case_hash;  ///< of the run folder it was started on; empty: any
    Capabilities capabilities;
};

/// What the case requires of a participant.
struct Expectation {
    Role role = Role::grains;
    std::string adapter;  ///< empty: any
    std::int32_t dimension = 2;
    std::int32_t ranks = 1;
    std::string case_hash;
    std::string scheme;                   ///< run.scheme, for messages
    bool effective_inertia = false;       ///< the scheme's order contains a FreeResponse
    bool restores_within_window = false;  ///< the scheme repeats windows of the grains
    std::vector<std::string> shapes;
};

/// Every mismatch as one sentence; empty if there is none.
std::vector<std::string> mismatches(const Hello& hello, const Expectation& expected);

}  // namespace turbidite
