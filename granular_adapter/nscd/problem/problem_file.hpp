// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact problem in the text format of Siconos (frictionContact_new_from_filename): find r, u
// with
//
//     u = W r + q,   q = H^T v_free + b,   Signorini-Coulomb between u and r
//
// d components per contact, (n, t) in the plane and (n, t, s) in space, in the frames and the order
// of the problem's contacts. W is given by d x d blocks (storage type 1, NM_SPARSE_BLOCK), every
// number with 17 digits, so that it is read back bit for bit. W is in 1/kg and q in m/s, or in the
// units of the problem.
//
//     d                              dimension
//     N                              contacts
//     1  dN  dN                      storage type, rows, columns (each on a line)
//     B  N  N                        blocks, block rows, block columns (each on a line)
//     d 2d ... dN   twice            ends of block rows and block columns
//     N+1  B                         lengths of the next two (each on a line)
//     row starts; block columns
//     per block: its number, then its entries column by column (each on a line)
//     q; mu
#pragma once

#include <iosfwd>

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument if there is no contact, or one with resistance to rolling or
/// torsion or with a film, or one on another rank: the format cannot express these.
void write_problem(std::ostream& out, const ContactProblem& problem);

}  // namespace turbidite::nscd
