// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/box_operators.hpp"

#include <algorithm>
#include <numeric>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {
namespace {

/// The grid, with values that sides leave alone.
SeparableOperator even(SeparableOperator grid) {
    for (AxisOperator* axis : {&grid.x, &grid.y, &grid.z})
        if (!axis->periodic()) axis->lower = axis->upper = End::neumann;
    return grid;
}

}  // namespace

BoxOperators::BoxOperators(const SeparableOperator& velocity, const SeparableOperator& pressure,
                           BoxRows& rows, const VelocityOnSides& sides)
    : layers_(pressure, rows),
      p_(pressure, rows),
      w_(even(pressure), rows),
      ends_(pressure, rows),
      q_x_(layers_.nx, 1),
      q_z_(layers_.nx, layers_.nz),
      below_(layers_.layer()),
      here_(below_),
      above_(below_),
      image_(below_),
      none_(layers_.nx, 0.0),
      faces_{Layer(layers_.nx + 1), below_, below_, none_, none_} {
    for (int axis = 0; axis < layers_.components(); ++axis) {
        // A change is zero where a side prescribes u: its reader has no values on the sides.
        velocity_.emplace_back(velocity, rows, &sides[axis]);
        change_.emplace_back(velocity, rows);
    }
}

/// work(j, k, the first cell of row k of layer j)
template <class Work>
void BoxOperators::for_rows(Work work) const {
    for (int j = 0; j < layers_.ny; ++j)
        for (int k = 0; k < layers_.nz; ++k) work(j, k, layers_.row(j, k));
}

double BoxOperators::sum_of_cells(const std::vector<double>& values) const {
    if (!layers_.heights.stretched()) return std::accumulate(values.begin(), values.end(), 0.0);
    double sum = 0.0;
    for (int j = 0; j < layers_.ny; ++j)
        sum += layers_.heights.relative(j) * std::accumulate(values.begin() + layers_.row(j, 0),
                                                             values.begin() + layers_.row(j + 1, 0),
                                                             0.0);
    return sum;
}

double BoxOperators::dot(const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0.0;
    for_rows([&](int j, int, std::size_t c) {
        sum += layers_.heights.relative(j) * dot_row(layers_.nx, a.data() + c, b.data() + c);
    });
    return sum;
}

double BoxOperators::volume() const {
    double sum = 0.0;
    for (int j = 0; j < layers_.ny; ++j)
        sum += layers_.heights.relative(j) * static_cast<double>(layers_.layer());
    return sum;
}

/// Of a row of layer j, whose values these are.
void BoxOperators::add_products(int j, const double* image, const double* d, const double* r,
                                ImageProducts& products) const {
    // Weighted by volumes: in this product D G, Q and L are symmetric.
    const double volume = layers_.heights.relative(j);
    const int nx = layers_.nx;
    products.direction += volume * dot_row(nx, image, d);
    products.residual += volume * dot_row(nx, image, r);
    products.itself += volume * dot_row(nx, image, image);
    products.step += volume * dot_row(nx, r, d);
}

void BoxOperators::laplacian(double share, int axis, const double* u, double* f) {
    RowReader& rows = velocity_[axis];
    rows.begin(u);
    for_rows(
        [&](int j, int k, std::size_t c) { differences().laplacian(j, k, share, rows, f + c); });
}

void BoxOperators::add_impulses(double sign, double step, const double* p, const VelocityRows& f,
                                const VelocityPointers& u) {
    p_.begin(p);
    for_rows([&](int j, int k, std::size_t c) {
        for (int axis = 0; axis < u.size(); ++axis) {
            // u += sign f, then u -= sign step G p
            add_row(layers_.nx, sign, f[axis].data() + c, u[axis] + c);
            differences().correct(axis, j, k, sign * step, p_, u[axis] + c, u[axis] + c);
        }
    });
}

void BoxOperators::gradient(double step, const double* p, const VelocityPointers& u) {
    p_.begin(p);
    gradient_rows(step, u);
}

void BoxOperators::direction(double step, const double* z, double beta, double* d,
                             const VelocityPointers& u) {
    // d becomes z + beta d as it is read, so that d and its gradient are one pass.
    p_.begin(d, [this, z, beta, d](int j) {
        const std::size_t c = layers_.row(j, 0);
        next_direction(static_cast<int>(layers_.layer()), z + c, beta, d + c);
    });
    gradient_rows(step, u);
}

/// u = -step G of what p_ reads.
void BoxOperators::gradient_rows(double step, const VelocityPointers& u) {
    for_rows([&](int j, int k, std::size_t c) {
        for (int axis = 0; axis < u.size(); ++axis)
            // 0 - step G p
            differences().correct(axis, j, k, step, p_, none_.data(), u[axis] + c);
    });
}

ViscousSums BoxOperators::viscous_residual(double share, int axis, const double* u, const double* f,
                                           double* r, double* again) {
    RowReader& rows = velocity_[axis];
    const int nx = layers_.nx;
    rows.begin(u);
    ViscousSums sums;
    for_rows([&](int j, int k, std::size_t c) {
        // r = share L u - f; its sums are taken while the row is in cache.
        differences().laplacian(j, k, share, rows, r + c);
        add_row(nx, -1.0, f + c, r + c);
        std::copy_n(r + c, nx, again + c);
        sums.square += layers_.heights.relative(j) * dot_row(nx, r + c, r + c);
        sums.sum += layers_.heights.relative(j) * sum_row(nx, r + c);
    });
    return sums;
}

ImageProducts BoxOperators::viscous_image(double share, int axis, const double* d, const double* v,
                                          const double* r, double* image) {
    RowReader& rows = change_[axis];
    rows.begin(v);
    ImageProducts products;
    for_rows([&](int j, int k, std::size_t c) {
        // Without `image` only the products count, and each row may overwrite the last.
        double* out = image ? image + c : image_.data();
        differences().laplacian(j, k, -share, rows, out);
        add_row(layers_.nx, 1.0, d + c, out);
        add_products(j, out, rows.row(j, k), r + c, products);
    });
    return products;
}

/// out = share D u of layer j.
void BoxOperators::divergence_of(int j, double share, std::vector<RowReader>& u, double* out) {
    const int nx = layers_.nx;
    const ThreeRows y = layers_.heights.central_difference(j, share);
    for (int k = 0; k < layers_.nz; ++k, out += nx) {
        const double* here = u[0].row(j, k);
        const double* below = u[1].row(j - 1, k);
        const double* across = u[1].row(j, k);
        const double* above = u[1].row(j + 1, k);
        // share ((u_{+1} - u_{-1})/(2 hx) + (S.v_{+1} - S.v)/h_j + (w_{+1} - w_{-1})/(2 hz))
        central_divergence_row(nx, 0.5 * share / layers_.hx, here - 1, here + 1, y, below, across,
                               above, out);
        if (layers_.in_space())
            subtract_difference(nx, -0.5 * share / layers_.hz, u[2].row(j, k - 1),
                                u[2].row(j, k + 1), out);
    }
}

double BoxOperators::flux_residual(double step, const double* p, const VelocityPointers& u,
                                   const ExcessFlux& excess, const PendingChange& change,
                                   double* r) {
    begin_velocity(u, change);
    begin_smoothing(excess, p);
    // Below layer 0; from then on the faces above a layer become those below the next.
    kept_below(0, excess, faces_.below.data());
    double sum = 0.0;
    for (int j = 0; j < layers_.ny; ++j) {
        double* out = r + layers_.row(j, 0);
        // r = -D u - div(kept e) - step Q p
        divergence_of(j, -1.0, velocity_, out);
        add_divergence_of_excess(j, excess, out);
        add_smoothing(j, -step, out);
        for (int k = 0; k < layers_.nz; ++k, out += layers_.nx)
            sum += layers_.heights.relative(j) * dot_row(layers_.nx, out, out);
    }
    return sum;
}

std::vector<int> BoxOperators::enclosed(const double* marks) {
    std::vector<int> cells;
    // Beyond a side lies the mirror image, or its negative where p is prescribed.
    p_.begin(marks);
    const int rows = layers_.in_space() ? 5 : 3;
    for (int j = 0; j < layers_.ny; ++j)
        for (int k = 0; k < layers_.nz; ++k) {
            const double* row[5] = {p_.row(j - 1, k), p_.row(j, k), p_.row(j + 1, k)};
            if (layers_.in_space()) row[3] = p_.row(j, k - 1), row[4] = p_.row(j, k + 1);
            for (int i = 0; i < layers_.nx; ++i) {
                bool all = row[1][i - 1] == 1.0 && row[1][i + 1] == 1.0;
                for (int r = 0; r < rows; ++r) all &= row[r][i] == 1.0;
                if (all) cells.push_back(static_cast<int>(layers_.row(j, k)) + i);
            }
        }
    return cells;
}

/// out -= div of what remains of e, of layer j; layers in ascending order.
void BoxOperators::add_divergence_of_excess(int j, const ExcessFlux& excess, double* out) {
    const int nx = layers_.nx;
    if (excess.film) excess.film->add_kept(j, -1.0, out);
    kept_below(j + 1, excess, faces_.above.data());
    if (layers_.in_space()) kept_behind(j, 0, excess, faces_.before.data());
    for (int k = 0; k < layers_.nz; ++k, out += nx) {
        const std::size_t row = static_cast<std::size_t>(k) * nx;
        kept_along(j, k, excess, faces_.along.data());
        add_divergence_row(nx, -1.0 / layers_.hx, faces_.along.data(), faces_.along.data() + 1,
                           -1.0 / layers_.heights.size(j), faces_.below.data() + row,
                           faces_.above.data() + row, out);
        if (!layers_.in_space()) break;
        // The faces in front of a row are those behind the next.
        faces_.behind.swap(faces_.before);
        kept_behind(j, k + 1, excess, faces_.before.data());
        subtract_difference(nx, 1.0 / layers_.hz, faces_.behind.data(), faces_.before.data(), out);
    }
    faces_.below.swap(faces_.above);
}

void BoxOperators::begin_velocity(const VelocityPointers& u, const PendingChange& pending) {
    for (int axis = 0; axis < u.size(); ++axis) {
        if (pending.share == 0.0) {
            velocity_[axis].begin(u[axis]);
            continue;
        }
        const auto change = [this, to = u[axis], by = pending.change[axis],
                             share = pending.share](int j) {
            const std::size_t c = layers_.row(j, 0);
            add_row(static_cast<int>(layers_.layer()), share, by + c, to + c);
        };
        velocity_[axis].begin(u[axis], change);
    }
}

/// What remains of e on the faces along row k of layer j, whose w has been read.
void BoxOperators::kept_along(int j, int k, const ExcessFlux& excess, double* face) {
    const double* w = w_.row(j, k);
    const int nx = layers_.nx;
    kept_row(nx + 1, w - 1, w, excess.e[0] + layers_.face_row(0, j, k), face);
    // On a side e is the flux minus the boundary value of this window: it is not carried over.
    if (!layers_.periodic_x) face[0] = face[nx] = 0.0;
}

/// What remains of e on the faces below layer j.
void BoxOperators::kept_below(int j, const ExcessFlux& excess, double* faces) {
    if (layers_.side_below(j)) {
        std::fill_n(faces, layers_.layer(), 0.0);
        return;
    }
    for (int k = 0; k < layers_.nz; ++k, faces += layers_.nx) {
        const double* below = w_.row(j - 1, k);
        kept_row(layers_.nx, below, w_.row(j, k), excess.e[1] + layers_.face_row(1, j, k), faces);
    }
}

/// What remains of e on the faces behind row k of layer j.
void BoxOperators::kept_behind(int j, int k, const ExcessFlux& excess, double* face) {
    if (layers_.side_behind(k)) {
        std::fill_n(face, layers_.nx, 0.0);
        return;
    }
    kept_row(layers_.nx, w_.row(j, k - 1), w_.row(j, k), excess.e[2] + layers_.face_row(2, j, k),
             face);
}

ImageProducts BoxOperators::flux_image(double step, const ExcessFlux& excess, const double* d,
                                       const VelocityPointers& u, const double* r, double* image) {
    for (int axis = 0; axis < u.size(); ++axis) change_[axis].begin(u[axis]);
    begin_smoothing(excess, d);
    ImageProducts products;
    for (int j = 0; j < layers_.ny; ++j) {
        double* out = image ? image + layers_.row(j, 0) : image_.data();
        // p + alpha d changes u by alpha u of this direction, hence r by -alpha (D u + step Q d).
        divergence_of(j, 1.0, change_, out);
        add_smoothing(j, step, out);
        for (int k = 0; k < layers_.nz; ++k, out += layers_.nx)
            add_products(j, out, d + layers_.row(j, k), r + layers_.row(j, k), products);
    }
    return products;
}

void BoxOperators::begin_smoothing(const ExcessFlux& excess, const double* p) {
    film_ = excess.film;
    w_.begin(excess.w);
    p_.begin(p);
    // q of the layers -1 and 0; below_, here_ and above_ move up with the layers.
    second_difference_across(-1, below_);
    second_difference_across(0, here_);
}

/// q = w d2 p along row k of layer j, extended beyond both ends as p is.
const double* BoxOperators::second_difference_along(int j, int k) {
    const double* p = p_.row(j, k);
    weighted_difference(layers_.nx, ones, w_.row(j, k), p - 1, p, p + 1, q_x_.row(0));
    ends_.extend(q_x_.row(0), j, k);
    return q_x_.row(0);
}

/// q along y of layer j.
void BoxOperators::second_difference_across(int j, Layer& q) {
    // q = w h_j ((p_{+1} - p)/d_{+1} - (p - p_{-1})/d), of equal rows w d2 p
    const RowShares shares = layers_.heights.over_distances(j, layers_.heights.size(j));
    for (int k = 0; k < layers_.nz; ++k) {
        const double* below = p_.row(j - 1, k);
        const double* here = p_.row(j, k);
        const double* above = p_.row(j + 1, k);
        weighted_difference(layers_.nx, shares, w_.row(j, k), below, here, above,
                            q.data() + static_cast<std::size_t>(k) * layers_.nx);
    }
}

/// q along z of layer j, extended as p is.
void BoxOperators::second_difference_between(int j) {
    for (int k = 0; k < layers_.nz; ++k)
        weighted_difference(layers_.nx, ones, w_.row(j, k), p_.row(j, k - 1), p_.row(j, k),
                            p_.row(j, k + 1), q_z_.row(k));
    ends_.extend(q_z_, j);
}

/// out += share Q p of layer j; layers in ascending order.
void BoxOperators::add_smoothing(int j, double share, double* out) {
    // Q p = d2 q/(4 h2) along x and z; along y the divergence of (q_{+1} - q)/(4d), over h_j d
    const double x = 0.25 * share / (layers_.hx * layers_.hx);
    const double z = 0.25 * share / (layers_.hz * layers_.hz);
    const RowShares y = layers_.heights.over_volumes(j, 0.25 * share);
    if (layers_.in_space()) second_difference_between(j);
    second_difference_across(j + 1, above_);
    if (film_) film_->add_driven(j, share, p_, out);
    for (int k = 0; k < layers_.nz; ++k, out += layers_.nx) {
        const std::size_t row = static_cast<std::size_t>(k) * layers_.nx;
        const double* q = second_difference_along(j, k);
        add_differences(layers_.nx, x, q - 1, q, q + 1, y, below_.data() + row, here_.data() + row,
                        above_.data() + row, out);
        if (layers_.in_space())
            add_second_difference(layers_.nx, z, q_z_.row(k - 1), q_z_.row(k), q_z_.row(k + 1),
                                  out);
    }
    below_.swap(here_);
    here_.swap(above_);
}

void BoxOperators::update_excess(double step, const double* p, const ExcessFlux& excess) {
    begin_smoothing(excess, p);
    for (int j = 0; j <= layers_.ny; ++j) {
        double* faces = excess.e[1] + layers_.face_row(1, j, 0);
        kept_below(j, excess, faces);
        // e += step (q_j - q_{j-1})/(4d) on the faces below layer j, up to those above the last one
        correct(static_cast<int>(layers_.layer()), -0.25 * step / layers_.heights.distance(j),
                below_.data(), here_.data(), faces, faces);
        // All faces of the layer below have been written.
        if (excess.film && j > 0) excess.film->update(j - 1, step, p_, excess.e);
        if (j == layers_.ny) break;
        update_excess_within(j, step, excess);
        second_difference_across(j + 1, above_);
        below_.swap(here_);
        here_.swap(above_);
    }
}

/// On the faces of the rows of layer j along x and z.
void BoxOperators::update_excess_within(int j, double step, const ExcessFlux& excess) {
    const double x = 0.25 * step / layers_.hx, z = 0.25 * step / layers_.hz;
    for (int k = 0; k < layers_.nz; ++k) {
        const double* q = second_difference_along(j, k);
        double* left = excess.e[0] + layers_.face_row(0, j, k);
        kept_along(j, k, excess, left);
        correct(layers_.nx + 1, -x, q - 1, q, left, left);
    }
    if (!layers_.in_space()) return;
    second_difference_between(j);
    for (int k = 0; k <= layers_.nz; ++k) {
        double* behind = excess.e[2] + layers_.face_row(2, j, k);
        kept_behind(j, k, excess, behind);
        correct(layers_.nx, -z, q_z_.row(k - 1), q_z_.row(k), behind, behind);
    }
}

}  // namespace turbidite
