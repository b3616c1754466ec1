// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/problem_file.hpp"

#include <cstdio>
#include <ostream>
#include <stdexcept>

#include "granular_adapter/nscd/problem/plane/delassus_matrix.hpp"

namespace turbidite::nscd {
namespace {

std::string digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.16e", value);
    return text;
}

void write_block(std::ostream& out, std::int64_t number, const Coupling& w) {
    out << number << '\n';
    // Column by column: W_nn, W_tn, W_nt, W_tt.
    for (const double value : {w.by_n[0], w.by_n[1], w.by_t[0], w.by_t[1]})
        out << digits(value) << '\n';
}

/// Calls use(column, W_kj) for every block of block row k, columns ascending, the diagonal in its
/// place.
template <class Use>
void for_row(const DelassusMatrix& w, std::size_t k, Use&& use) {
    const Block& d = w.diagonal[k];
    const auto own = static_cast<std::int32_t>(k);
    bool passed = false;
    const auto diagonal = [&] { use(own, Coupling{{d.nn, d.nt}, {d.nt, d.tt}}), passed = true; };
    for (std::int64_t e = w.row_start[k]; e < w.row_start[k + 1]; ++e) {
        if (!passed && w.column[e] > own) diagonal();
        use(w.column[e], w.coupling[e]);
    }
    if (!passed) diagonal();
}

void write_matrix(std::ostream& out, const DelassusMatrix& w) {
    const std::size_t n = w.size(), blocks = w.column.size() + n;
    out << 1 << '\n' << 2 * n << '\n' << 2 * n << '\n';
    out << blocks << '\n' << n << '\n' << n << '\n';
    for (int side = 0; side < 2; ++side) {
        for (std::size_t k = 1; k <= n; ++k) out << 2 * k << '\t';
        out << '\n';
    }
    out << n + 1 << '\n' << blocks << '\n';
    for (std::size_t k = 0; k <= n; ++k) out << w.row_start[k] + std::int64_t(k) << '\t';
    out << '\n';
    for (std::size_t k = 0; k < n; ++k)
        for_row(w, k, [&](std::int32_t column, const Coupling&) { out << column << '\t'; });
    out << '\n';
    std::int64_t number = 0;
    for (std::size_t k = 0; k < n; ++k)
        for_row(w, k,
                [&](std::int32_t, const Coupling& block) { write_block(out, number++, block); });
}

}  // namespace

void write_problem(std::ostream& out, const ContactProblem& problem) {
    if (problem.contacts.empty())
        throw std::invalid_argument("a contact problem without contacts cannot be written");
    if (dimension(problem.bodies) != 2)
        throw std::invalid_argument(
            "contact problems of space cannot be written: leave contact.dump_interval out");
    if (has_rolling(problem))
        throw std::invalid_argument(
            "contact problems with rolling resistance cannot be written: the format of Siconos has "
            "normal and tangent only");
    out << 2 << '\n' << problem.contacts.size() << '\n';
    write_matrix(out, DelassusMatrix(problem));
    for (const Plane& u : free_contact_velocities(problem))
        out << digits(u[0]) << ' ' << digits(u[1]) << '\n';
    for (const Contact& contact : problem.contacts) out << digits(contact.friction) << '\n';
}

}  // namespace turbidite::nscd
