// SPDX-License-Identifier: GPL-2.0-or-later
//
// Differences on the rows of a box, for what is solved with rigid grains in the fluid. With
// u, p at cell centres and G, D the central differences, and with d2 the second difference along
// one axis (h the spacing, sides as in row_reader.hpp):
//
//     G p    = (p_{+1} - p_{-1})/(2h)
//     D u    = sum over axes of (u_{+1} - u_{-1})/(2h)
//     L u    = sum over axes of d2 u/h2
//     flux   = S.u + e,    e = w e_old + dt (q_{+1} - q)/(4h) on the face between two cells,
//                          q = w d2 p
//     Q p    = sum over axes of d2 q/(4 h2)
//
// e is the velocity that a face has beyond S.u. In the fluid w = k = 1/(1 + 4 nu dt/h2), which is
// implicit in time, (e - e_old)/dt = -(dp/dn - S.G p) - 4 nu/h2 e: in steady flow e does not depend
// on dt. With w = 1 the flux is what the projection (box_step.hpp) leaves for this p: -D G p + Q p
// is minus the compact Laplacian. w = 0 in cells inside grains, where the fluid is rigid: faces
// between two such cells carry S.u and no more, and Q stays symmetric.
//
// Faces of a film between cells of grains that touch (wedge_flow.hpp) carry its e, to which div e
// and Q p belong in the same way.
//
// Where rows have heights h_j of their own, along y with D of S.v and G of row_heights.hpp and s
// the slope of p between two rows: q = w h (s_{+1} - s), e = dt (q_{+1} - q)/(4d), and Q p is the
// divergence of e. All products are weighted by volumes: in them G and D, Q and L are symmetric.
//
// Each function reads and writes its arrays once, a layer at a time; sums that the caller needs are
// taken while a row is in cache, and are those of this rank. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/box_step/box_fluid.hpp"
#include "fluid_adapter/box_step/row_differences.hpp"
#include "fluid_adapter/box_step/wedge_flow.hpp"

namespace turbidite {

/// Of the image A d of a direction d.
struct ImageProducts {
    double direction = 0.0;  ///< with d, in the product the method uses
    double residual = 0.0;   ///< with r
    double itself = 0.0;
    double step = 0.0;  ///< of d with r, in the same product as `direction`

    static constexpr int count = 4;
    double* data() { return &direction; }
};
static_assert(sizeof(ImageProducts) == ImageProducts::count * sizeof(double));

/// Of a residual of viscosity, one component.
struct ViscousSums {
    double square = 0.0;  ///< r.r
    double sum = 0.0;     ///< of r
};

/// The excess flux of the last window, laid out as BoxStep::excess, of which the part w remains on
/// faces (the larger w of their two cells), what wedge_flow.hpp says on those of a film, and
/// nothing on the sides of the box.
struct ExcessFlux {
    VelocityPointers e;
    const double* w;                  ///< over the rank's cells, 0 to 1
    const WedgeFlow* film = nullptr;  ///< none: no face has one
};

/// A change of velocity, u += share change, still to be made by the kernel that next reads u.
struct PendingChange {
    double share = 0.0;
    Components<const double*> change = Components<const double*>();
};

class BoxOperators {
 public:
    /// `rows` and the values on the sides must outlive it.
    BoxOperators(const SeparableOperator& velocity, const SeparableOperator& pressure,
                 BoxRows& rows, const VelocityOnSides& sides);

    std::size_t size() const { return layers_.cells(); }
    int components() const { return layers_.components(); }

    /// Sum over the rank's cells, weighted by volumes over those of cells that are not stretched.
    double sum_of_cells(const std::vector<double>& values) const;

    /// The same of a[c] b[c].
    double dot(const std::vector<double>& a, const std::vector<double>& b) const;

    /// The same of 1.
    double volume() const;

    /// This rank's cells with 1 in them and in all cells beside them, those of other ranks
    /// included; a side that prescribes no pressure counts as a 1. By every rank.
    std::vector<int> enclosed(const double* marks);

    // By every rank; arrays of this rank's rows. A velocity has the values that sides prescribe, a
    // change of a velocity is zero there.

    /// f = share L u, of the component of a velocity along `axis`
    void laplacian(double share, int axis, const double* u, double* f);

    /// u += sign (f - step G p)
    void add_impulses(double sign, double step, const double* p, const VelocityRows& f,
                      const VelocityPointers& u);

    /// u = -step G p
    void gradient(double step, const double* p, const VelocityPointers& u);

    /// d = z + beta d, u = -step G d
    void direction(double step, const double* z, double beta, double* d, const VelocityPointers& u);

    /// r = share L u - f, of the component of a velocity. `again`: a second copy of r.
    ViscousSums viscous_residual(double share, int axis, const double* u, const double* f,
                                 double* r, double* again);

    /// A d = d - share L v, of one component of v = W d, a change; its products with v, r, itself,
    /// and that of r with v. `image`: where it is kept, unless null.
    ImageProducts viscous_image(double share, int axis, const double* d, const double* v,
                                const double* r, double* image);

    /// r = -(D u + div e + step Q p) of a velocity, which is changed first; returns r.r
    double flux_residual(double step, const double* p, const VelocityPointers& u,
                         const ExcessFlux& excess, const PendingChange& change, double* r);

    /// A d = D u + step Q d of a change of velocity; its products with d, r, itself, and that
    /// of r with d. `image`: where it is kept, unless null.
    ImageProducts flux_image(double step, const ExcessFlux& excess, const double* d,
                             const VelocityPointers& u, const double* r, double* image);

    /// e = what remains of it + step (q_{+1} - q)/(4h)
    void update_excess(double step, const double* p, const ExcessFlux& excess);

 private:
    using Layer = std::vector<double>;

    /// Kept excess on the faces of a row along x, of two layers, and in space of two rows.
    struct Faces {
        Layer along, below, above, behind, before;
    };

    RowDifferences differences() const { return {layers_}; }
    template <class Work>
    void for_rows(Work work) const;
    void add_products(int j, const double* image, const double* d, const double* r,
                      ImageProducts& products) const;
    void gradient_rows(double step, const VelocityPointers& u);
    void divergence_of(int j, double share, std::vector<RowReader>& u, double* out);
    void add_divergence_of_excess(int j, const ExcessFlux& excess, double* out);
    void begin_velocity(const VelocityPointers& u, const PendingChange& pending);
    void kept_along(int j, int k, const ExcessFlux& excess, double* face);
    void kept_below(int j, const ExcessFlux& excess, double* faces);
    void kept_behind(int j, int k, const ExcessFlux& excess, double* face);
    void begin_smoothing(const ExcessFlux& excess, const double* p);
    const double* second_difference_along(int j, int k);
    void second_difference_across(int j, Layer& q);
    void second_difference_between(int j);
    void add_smoothing(int j, double share, double* out);
    void update_excess_within(int j, double step, const ExcessFlux& excess);

    BoxLayers layers_;
    std::vector<RowReader> velocity_, change_;  // by component
    RowReader p_, w_;
    RowReader ends_;              // extends q
    PaddedLayer q_x_, q_z_;       // q along x of a row, along z of a layer
    Layer below_, here_, above_;  // q along y of three layers
    Layer image_, none_;
    Faces faces_;
    const WedgeFlow* film_ = nullptr;  // of the pass at hand
};

}  // namespace turbidite
