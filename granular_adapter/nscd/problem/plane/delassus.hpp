// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Delassus operator W = H^T M^-1 H (Topin 2011, Eq. 19): contact impulses to the change of contact
// velocity that they cause, u = H^T v_free + b + W r. [1/kg]
//
// Differs from the paper: r is an impulse, not a force, so W carries no dt. W is applied, never
// assembled; only its diagonal blocks are stored, in (n, t, roll). For discs the arms are parallel
// to n, hence W_nt = 0 in every block, unless a body's mobility prefers a direction or couples it
// to spin.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/contact_problem.hpp"
#include "granular_adapter/nscd/problem/plane/one_contact.hpp"

namespace turbidite::nscd {

class Delassus {
 public:
    /// Keeps a reference: the problem must live as long.
    explicit Delassus(const ContactProblem& problem);

    const Block& block(std::size_t contact) const { return blocks_[contact]; }

    /// W r: u_n, u_t and w of every contact.
    Impulses apply(const Impulses& r) const;

    /// True when arms are along the normals, no block couples and every mobility is isotropic.
    bool diagonal() const { return diagonal_; }

    /// True when some contact resists rolling. Blocks have a third row only where one does, and a
    /// zero one where neither body can turn: then no moment acts.
    bool rolling() const { return rolling_; }

 private:
    const ContactProblem& problem_;
    std::vector<Block> blocks_;
    bool diagonal_ = true, rolling_ = false;
};

}  // namespace turbidite::nscd
