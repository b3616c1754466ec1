// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The programs that move the grains and their capabilities: the single table read by keys, rules
// and the launch line. A new adapter is its own program or script, and an entry of
// grains_adapter_table.def.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "coupler/keys/key_spec.hpp"
#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct SchemeEntry;

/// What runs the adapter's file.
enum class GrainsHost {
    none,     ///< it is a program itself, BUILD/bin/FILE
    yade,     ///< YADE runs the script BUILD/lib/yade/FILE
    command,  ///< the user names the program: grains.command
};

constexpr int any_number = std::numeric_limits<int>::max();

struct GrainsAdapter {
    std::string name;  ///< grains.adapter
    std::string help;  ///< one line
    Contacts contacts = Contacts::any;
    GrainsHost host = GrainsHost::none;
    std::string file = {};                 ///< empty: planned for a later version
    std::vector<std::string> shapes = {};  ///< grains.shape
    bool takes_inertia = false;            ///< of the fluid, into its contacts
    bool repeats_windows = false;          ///< goes back to the start of a window
    std::vector<std::string> laws = {};    ///< contact.law; empty: all
    bool adhesion_and_rolling = false;     ///< contact.adhesion, contact.rolling_friction
    bool films = false;                    ///< contact.film
    bool cyclic_sides = false;
    bool inner_walls = false;        ///< domain.walls_file
    bool moving_sides = false;       ///< domain.SIDE_motion
    bool materials = false;          ///< more than the first, contact.pairs
    bool prescribed_grains = false;  ///< fixed and driven ones
    bool moved_grains = false;       ///< that follow a motion of domain.motions
    int most_ranks = 1;
    bool resumes_on_other_ranks = false;  ///< than those that saved the state
    double disc_substep = 0.4e-6;         ///< of springs: time per disc and sub-step [s]

    /// False: planned for a later version.
    bool available() const { return !file.empty() || host == GrainsHost::command; }
};

/// What every host of the contact engine can do.
GrainsAdapter contact_engine(const char* name, const char* help, GrainsHost host, const char* file);

/// The same with any number of ranks.
GrainsAdapter on_ranks(GrainsAdapter adapter);

/// A program of the user's own. The handshake says which shapes and schemes it supports; the rest
/// it has to refuse itself.
GrainsAdapter external_program(const char* name, const char* help);

/// The entries of grains_adapter_table.def.
const std::vector<GrainsAdapter>& grains_adapters();

/// The adapter of grains.adapter. Throws Failure (bad input) for a name that is unknown or has no
/// program in this version.
const GrainsAdapter& grains_adapter(const Settings& settings);

/// Whether several ranks of this project's contact engine share the contacts.
bool shares_contacts(const Settings& settings);

/// Whether the adapter can play its part in a scheme with a fluid.
bool supports(const GrainsAdapter& adapter, const SchemeEntry& scheme);

/// The scheme that coupling.scheme: auto stands for with this adapter: the one with the fluid's
/// inertia if it is known to take it; a program of the user's own has to be asked for it.
const SchemeEntry& best_scheme(const GrainsAdapter& adapter);

/// The adapters of this project with a capability, as text: "yade-nscd or standalone-nscd".
std::string adapters_that(bool (*can)(const GrainsAdapter&));

}  // namespace turbidite
