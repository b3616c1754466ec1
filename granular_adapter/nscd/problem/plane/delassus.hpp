// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Delassus operator W = H^T M^-1 H (Topin 2011, Eq. 19): maps contact impulses to the change of
// contact velocity they cause, u = H^T v_free + b + W r. [1/kg]
//
// Unlike in the paper r is an impulse, not a force, so W does not contain dt. W is applied, never
// assembled; only its diagonal blocks are stored, in (n, t, roll). For discs the arms are parallel
// to n, hence W_nt = 0 in every block, unless the mobility of a body is anisotropic or couples
// translation to spin.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/contact_problem.hpp"
#include "granular_adapter/nscd/problem/plane/one_contact.hpp"

namespace turbidite::nscd {

class Delassus {
 public:
    /// Keeps a reference to the problem, which must outlive it.
    explicit Delassus(const ContactProblem& problem);

    const Block& block(std::size_t contact) const { return blocks_[contact]; }

    /// W r: the changes of u_n, u_t and w of every contact.
    Impulses apply(const Impulses& r) const;

    /// True if all arms are along the normals, no block couples n and t, and every mobility is
    /// isotropic.
    bool diagonal() const { return diagonal_; }

    /// True if some contact has rolling resistance. Only the blocks of such contacts have a
    /// non-zero third row, and not even these if neither body can rotate: then there is no moment.
    bool rolling() const { return rolling_; }

 private:
    const ContactProblem& problem_;
    std::vector<Block> blocks_;
    bool diagonal_ = true, rolling_ = false;
};

}  // namespace turbidite::nscd
