// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/quasi_newton.hpp"

#include <Eigen/QR>

namespace turbidite {
namespace {

/// Columns that are nearly combinations of others are noise.
constexpr double independent = 1e-7;

}  // namespace

Eigen::VectorXd QuasiNewton::step(const Eigen::VectorXd& residual) {
    // The caller never knows x itself, only its changes: x_0 is taken as zero. H(x_k) = x_k + r_k.
    if (residuals_.empty()) x_ = Eigen::VectorXd::Zero(residual.size());
    const Eigen::VectorXd image = x_ + residual;
    Eigen::VectorXd next = image;
    const auto earlier = static_cast<Eigen::Index>(residuals_.size());
    if (earlier > 0) {
        // Columns r_i - r_k and H(x_i) - H(x_k) of the iterations of this window.
        Eigen::MatrixXd of_residuals(residual.size(), earlier), of_images = of_residuals;
        for (Eigen::Index i = 0; i < earlier; ++i) {
            of_residuals.col(i) = residuals_[static_cast<std::size_t>(i)] - residual;
            of_images.col(i) = images_[static_cast<std::size_t>(i)] - image;
        }
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(of_residuals);
        qr.setThreshold(independent);
        // The a_i of least |r_k + sum_i a_i (r_i - r_k)|; pivoting leaves out columns below the
        // threshold.
        next += of_images * qr.solve(-residual);
    }
    residuals_.push_back(residual);
    images_.push_back(image);
    const Eigen::VectorXd change = next - x_;
    x_ = next;
    return change;
}

}  // namespace turbidite
