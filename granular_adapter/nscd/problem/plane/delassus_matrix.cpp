// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"

#include <algorithm>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/plane/delassus.hpp"

namespace turbidite::nscd {
namespace {

/// One end of a contact: directions n and t as (x, y, spin) of the body, with the sign of the
/// impulse on it.
struct End {
    std::int32_t contact;
    std::array<PlanarVector, 2> direction;
};

End end_of(const Contact& contact, std::int32_t index, bool at_b) {
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

/// The contacts of every movable body, in order.
std::vector<std::vector<End>> ends_by_body(const ContactProblem& problem,
                                           const std::vector<PlanarTensor>& bodies) {
    std::vector<std::vector<End>> ends(bodies.size());
    const auto add = [&](std::int32_t body, std::int32_t k, bool at_b) {
        if (body < 0) return;
        // An immovable body couples no contacts: M^-1 = 0.
        if (!is_immovable(bodies[body])) ends[body].push_back(end_of(problem.contacts[k], k, at_b));
    };
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(problem.contacts.size()); ++k) {
        add(problem.contacts[k].a, k, false);
        add(problem.contacts[k].b, k, true);
    }
    return ends;
}

void add_share(Coupling& w, const BodyMobility& body, const End& row, const End& column) {
    const PlanarVector by_n = body * column.direction[0], by_t = body * column.direction[1];
    for (int d = 0; d < 2; ++d) {
        // W_kj = H_k^T M^-1 H_j, column by column.
        w.by_n[d] += dot(row.direction[d], by_n);
        w.by_t[d] += dot(row.direction[d], by_t);
    }
}

Coupling transposed(const Coupling& w) {
    return {{w.by_n[0], w.by_t[0]}, {w.by_n[1], w.by_t[1]}};
}

struct RowEntry {
    std::int32_t column;
    Coupling share;
    bool operator<(const RowEntry& other) const { return column < other.column; }
};

/// Contributions of one body to block row k. Always computed as W_ij with i < j, so that both
/// halves of W round alike.
void collect(std::vector<RowEntry>& row, const BodyMobility& body, const std::vector<End>& ends,
             std::int32_t k) {
    const auto own =
        std::lower_bound(ends.begin(), ends.end(), k,
                         [](const End& end, std::int32_t i) { return end.contact < i; });
    for (const End& other : ends) {
        if (other.contact == k) continue;
        Coupling w;
        if (k < other.contact) {
            add_share(w, body, *own, other);
        } else {
            add_share(w, body, other, *own);
            w = transposed(w);
        }
        row.push_back({other.contact, w});
    }
}

}  // namespace

DelassusMatrix::DelassusMatrix(const ContactProblem& problem) {
    const Delassus blocks(problem);
    const std::vector<std::vector<End>> ends = ends_by_body(problem, blocks.bodies());
    row_start.push_back(0);
    std::vector<RowEntry> row;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(problem.contacts.size()); ++k) {
        const Contact& contact = problem.contacts[k];
        diagonal.push_back(blocks.block(k));
        row.clear();
        for (const std::int32_t body : {contact.a, contact.b})
            if (body >= 0 && !ends[body].empty())
                collect(row, blocks.bodies()[body], ends[body], k);
        // Stable: two contacts that share both bodies get their shares in the order a, b.
        std::stable_sort(row.begin(), row.end());
        for (const RowEntry& entry : row) {
            const bool same = std::int64_t(column.size()) > row_start.back() &&
                              column.back() == entry.column;  // the contacts share both bodies
            if (!same) column.push_back(entry.column), coupling.emplace_back();
            for (int d = 0; d < 2; ++d) {
                coupling.back().by_n[d] += entry.share.by_n[d];
                coupling.back().by_t[d] += entry.share.by_t[d];
            }
        }
        row_start.push_back(static_cast<std::int64_t>(column.size()));
    }
}

std::vector<Plane> free_contact_velocities(const ContactProblem& problem) {
    std::vector<Plane> u;
    u.reserve(problem.contacts.size());
    for (const Contact& contact : problem.contacts) {
        const ContactVector free = contact_velocity(contact, problem.free) + contact.bias;
        u.push_back({free.n, free.t});
    }
    return u;
}

bool has_rolling(const ContactProblem& problem) {
    return std::any_of(problem.contacts.begin(), problem.contacts.end(),
                       [](const Contact& contact) { return contact.rolling > 0.0; });
}

}  // namespace turbidite::nscd
