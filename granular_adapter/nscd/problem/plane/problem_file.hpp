// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact problem in the text format of Siconos (frictionContact_new_from_filename): find r, u
// with
//
//     u = W r + q,   q = H^T v_free + b,   Signorini-Coulomb between u and r
//
// two components (n, t) per contact, contacts in the order of the problem. W is given by 2x2 blocks
// (storage type 1, NM_SPARSE_BLOCK), every number with 17 digits, so that it is read back bit for
// bit. W is in 1/kg and q in m/s, or in the units of the problem.
//
//     2                              dimension
//     N                              contacts
//     1  2N  2N                      storage type, rows, columns (each on a line)
//     B  N  N                        blocks, block rows, block columns (each on a line)
//     2 4 ... 2N   twice             ends of block rows and block columns
//     N+1  B                         lengths of the next two (each on a line)
//     row starts; block columns
//     per block: its number, then W_nn, W_tn, W_nt, W_tt (each on a line)
//     q; mu
#pragma once

#include <iosfwd>

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument if there is no contact, or one with rolling resistance: the format
/// cannot express either; and for a problem of space.
void write_problem(std::ostream& out, const ContactProblem& problem);

}  // namespace turbidite::nscd
