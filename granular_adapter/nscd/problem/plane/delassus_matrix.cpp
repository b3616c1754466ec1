// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/plane/delassus.hpp"

namespace turbidite::nscd {

Coupling& Coupling::operator+=(const Coupling& share) {
    for (int d = 0; d < 2; ++d) by_n[d] += share.by_n[d], by_t[d] += share.by_t[d];
    return *this;
}

Coupling::End Coupling::end_of(const Contact& contact, std::int32_t index, bool at_b) {
    const Vec3& arm = at_b ? contact.arm_b : contact.arm_a;
    const double sign = at_b ? 1.0 : -1.0;
    End end{index, {}};
    for (int d = 0; d < 2; ++d) {
        const Vec3& e = d == 0 ? contact.normal : contact.tangent;
        // H_k of this body: +r acts on b, -r on a.
        end.direction[d] = {sign * e[0], sign * e[1], sign * cross_z(arm, e)};
    }
    return end;
}

Coupling Coupling::share(const PlanarTensor& body, const End& row, const End& column) {
    const PlanarVector by_n = body * column.direction[0], by_t = body * column.direction[1];
    Coupling w;
    for (int d = 0; d < 2; ++d) {
        // W_kj = H_k^T M^-1 H_j, column by column.
        w.by_n[d] = dot(row.direction[d], by_n);
        w.by_t[d] = dot(row.direction[d], by_t);
    }
    return w;
}

Coupling Coupling::transposed(const Coupling& w) {
    return {{w.by_n[0], w.by_t[0]}, {w.by_n[1], w.by_t[1]}};
}

DelassusMatrix::DelassusMatrix(const ContactProblem& problem) {
    const Delassus blocks(problem);
    static_cast<CoupledRows<Coupling>&>(*this) = coupled_rows<Coupling>(problem, blocks.bodies());
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) diagonal.push_back(blocks.block(k));
}

}  // namespace turbidite::nscd
