// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/problem_file.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>
#include <stdexcept>

#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"
#include "granular_adapter/nscd/problem/space/sphere_matrix.hpp"

namespace turbidite::nscd {
namespace {

std::string digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.16e", value);
    return text;
}

// The entries of a block, column by column.

std::array<double, 4> entries(const Coupling& w) {
    return {w.by_n[0], w.by_n[1], w.by_t[0], w.by_t[1]};
}

std::array<double, 4> entries(const Block& w) {
    return {w.nn, w.nt, w.nt, w.tt};
}

std::array<double, 9> entries(const SphereCoupling& w) {
    return w.entry;
}

/// Calls use(column, entries) for every block of block row k, columns ascending, the diagonal in
/// its place.
template <class Matrix, class Use>
void for_row(const Matrix& w, std::size_t k, Use&& use) {
    const auto own = static_cast<std::int32_t>(k);
    bool passed = false;
    const auto diagonal = [&] { use(own, entries(w.diagonal[k])), passed = true; };
    for (std::int64_t e = w.row_start[k]; e < w.row_start[k + 1]; ++e) {
        if (!passed && w.column[e] > own) diagonal();
        use(w.column[e], entries(w.coupling[e]));
    }
    if (!passed) diagonal();
}

template <class Matrix>
void write_structure(std::ostream& out, const Matrix& w, std::size_t d) {
    const std::size_t n = w.size(), blocks = w.column.size() + n;
    out << 1 << '\n' << d * n << '\n' << d * n << '\n';
    out << blocks << '\n' << n << '\n' << n << '\n';
    for (int side = 0; side < 2; ++side) {
        for (std::size_t k = 1; k <= n; ++k) out << d * k << '\t';
        out << '\n';
    }
    out << n + 1 << '\n' << blocks << '\n';
    for (std::size_t k = 0; k <= n; ++k) out << w.row_start[k] + std::int64_t(k) << '\t';
    out << '\n';
    for (std::size_t k = 0; k < n; ++k)
        for_row(w, k, [&](std::int32_t column, const auto&) { out << column << '\t'; });
    out << '\n';
}

template <class Matrix>
void write_matrix(std::ostream& out, const Matrix& w, std::size_t d) {
    write_structure(out, w, d);
    std::int64_t number = 0;
    for (std::size_t k = 0; k < w.size(); ++k)
        for_row(w, k, [&](std::int32_t, const auto& block) {
            out << number++ << '\n';
            for (const double value : block) out << digits(value) << '\n';
        });
}

void refuse_what_the_format_lacks(const ContactProblem& problem) {
    const auto turns = [](const Contact& contact) {
        return contact.rolling > 0.0 || contact.torsion > 0.0;
    };
    if (problem.contacts.empty())
        throw std::invalid_argument("a contact problem without contacts cannot be written");
    if (std::any_of(problem.contacts.begin(), problem.contacts.end(), turns))
        throw std::invalid_argument(
            "contact problems with resistance to rolling or torsion cannot be written: the format "
            "of Siconos has normal and tangent only");
    if (!problem.films.empty())
        throw std::invalid_argument(
            "contact problems with films cannot be written: the format of Siconos has "
            "Signorini-Coulomb only");
    if (problem.ranks)
        throw std::invalid_argument("contact problems shared by ranks cannot be written");
}

}  // namespace

void write_problem(std::ostream& out, const ContactProblem& problem) {
    refuse_what_the_format_lacks(problem);
    const bool space = dimension(problem.bodies) == 3;
    out << (space ? 3 : 2) << '\n' << problem.contacts.size() << '\n';
    if (space)
        write_matrix(out, SphereMatrix(problem), 3);
    else
        write_matrix(out, DelassusMatrix(problem), 2);
    for (const Contact& contact : problem.contacts) {
        const ContactVector q = contact_velocity(contact, problem.free) + contact.bias;
        out << digits(q.n) << ' ' << digits(q.t);
        if (space) out << ' ' << digits(q.s);
        out << '\n';
    }
    for (const Contact& contact : problem.contacts) out << digits(contact.friction) << '\n';
}

}  // namespace turbidite::nscd
