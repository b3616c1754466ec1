// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Step 5 solved in another way, for comparison: no multiplier is eliminated; all points of all
// grains are rows of one dense matrix S = B m^-1 B^T + T C^-1 T^T, C = diag(cM, cM, cI), which is
// solved directly.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <array>

#include "fluid_adapter/multiplier/plane/collocation_points.hpp"

namespace turbidite {

class DenseReference {
 public:
    DenseReference(FluidField& field, const std::vector<ImmersedGrain>& grains,
                   const CollocationPoints& points)
        : field_(field),
          grains_(grains),
          B_(points.size(), field.local_cells()),
          per_mass_(field.local_cells()) {
        B_.setZero();
        per_mass_.setOnes();
        for (int g = 0; g < points.grains(); ++g) {
            for (int i = points.interior_begin[g]; i < points.interior_begin[g + 1]; ++i) {
                const InteriorCell& point = points.interior[i];
                B_(rows_.size(), point.cell) = 1.0;
                per_mass_[point.cell] = 1.0 / point.volume;
                rows_.push_back({g, point.arm_x, point.arm_y});
            }
            for (int p = points.boundary_begin[g]; p < points.boundary_begin[g + 1]; ++p) {
                for (int s = points.stencil[p]; s < points.stencil[p + 1]; ++s)
                    B_(rows_.size(), points.cell(s)) = points.weight[s];
                rows_.push_back({g, points.arm_x[p], points.arm_y[p]});
            }
        }
        for (const StencilCell& at : points.stencilled) per_mass_[at.cell] = 1.0 / at.volume;
        per_mass_ /= field.reference_mass();
    }

    /// Motions of all grains; `pushes`: additional impulses.
    std::vector<Planar> motions(const std::vector<Planar>& pushes) {
        const int n = static_cast<int>(rows_.size());
        Eigen::MatrixXd T(2 * n, 3 * grains_.size());
        T.setZero();
        for (int i = 0; i < n; ++i) {
            const int g = 3 * rows_[i].grain;
            T.row(i).segment<3>(g) << 1.0, 0.0, -rows_[i].arm_y;
            T.row(n + i).segment<3>(g) << 0.0, 1.0, rows_[i].arm_x;
        }
        Eigen::VectorXd inverse(3 * grains_.size()), free(3 * grains_.size());
        for (std::size_t g = 0; g < grains_.size(); ++g) {
            const double m = grains_[g].effective_mass, I = grains_[g].effective_inertia;
            if (grains_[g].prescribed) {
                inverse.segment<3>(3 * g).setZero();
                free.segment<3>(3 * g) = planar(grains_[g].contact_motion);
                continue;
            }
            inverse.segment<3>(3 * g) << 1.0 / m, 1.0 / m, 1.0 / I;
            free.segment<3>(3 * g) =
                inverse.segment<3>(3 * g).cwiseProduct(planar(grains_[g].momentum()) + pushes[g]);
        }
        const Eigen::SparseMatrix<double> B = B_.sparseView();  // at most nine entries in a row
        const Eigen::MatrixXd gram(B * per_mass_.asDiagonal() * B.transpose());
        Eigen::MatrixXd S = T * inverse.asDiagonal() * T.transpose();
        S.topLeftCorner(n, n) += gram;
        S.bottomRightCorner(n, n) += gram;
        const Eigen::Map<Eigen::VectorXd> ux(field_.velocity(0), field_.local_cells()),
            uy(field_.velocity(1), field_.local_cells());
        Eigen::VectorXd slip(2 * n);
        slip << B_ * ux, B_ * uy;
        slip -= T * free;
        const Eigen::VectorXd moved = free + inverse.cwiseProduct(T.transpose() * solved(S, slip));
        std::vector<Planar> result;
        for (std::size_t g = 0; g < grains_.size(); ++g) result.push_back(moved.segment<3>(3 * g));
        return result;
    }

 private:
    /// S is indefinite if a grain is lighter than the fluid (cM < 0).
    static Eigen::VectorXd solved(const Eigen::MatrixXd& S, const Eigen::VectorXd& slip) {
        const Eigen::LLT<Eigen::MatrixXd> factors(S);
        if (factors.info() == Eigen::Success) return factors.solve(slip);
        return S.partialPivLu().solve(slip);
    }

    struct Row {
        int grain;
        double arm_x, arm_y;
    };

    FluidField& field_;
    const std::vector<ImmersedGrain>& grains_;
    Eigen::MatrixXd B_;
    Eigen::VectorXd per_mass_;  // 1/m_c
    std::vector<Row> rows_;
};

}  // namespace turbidite
