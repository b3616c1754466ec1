// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/newton_equation.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <stdexcept>

namespace turbidite::nscd {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Cholesky = Eigen::SimplicialLDLT<Matrix>;
using Vector = Eigen::VectorXd;

constexpr double accuracy = 1e-7;  ///< of a step; the next one corrects it
constexpr int most_products = 40;

void demand(Eigen::ComputationInfo info) {
    if (info != Eigen::Success)
        throw std::runtime_error("proximal-newton: the sparse factorisation failed");
}

/// A factorisation that is there already, in the form that Eigen's iterative solvers ask for.
class Preconditioner {
 public:
    using StorageIndex = int;
    enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };

    void use(const Cholesky& factors) { factors_ = &factors; }
    template <class M>
    Preconditioner& analyzePattern(const M&) {
        return *this;
    }
    template <class M>
    Preconditioner& factorize(const M&) {
        return *this;
    }
    template <class M>
    Preconditioner& compute(const M&) {
        return *this;
    }
    Vector solve(const Vector& right) const { return factors_->solve(right); }
    Eigen::ComputationInfo info() const { return Eigen::Success; }

 private:
    const Cholesky* factors_ = nullptr;
};

}  // namespace

Vector NewtonEquation::solve(AugmentedSystem& system, double weight, const Vector& g) {
    if (weight != weight_ || system.statuses() != statuses_) factorise(system, weight);
    if (!full_ready_) {
        Eigen::BiCGSTAB<Matrix, Preconditioner> iteration;
        iteration.preconditioner().use(symmetric_);
        iteration.compute(jacobian_);
        iteration.setTolerance(accuracy);
        iteration.setMaxIterations(most_products);
        Vector step = iteration.solve(g);
        if (iteration.info() == Eigen::Success) return step;
        if (!full_analysed_) full_.analyzePattern(jacobian_), full_analysed_ = true;
        full_.factorize(jacobian_);
        demand(full_.info());
        full_ready_ = true;
    }
    return full_.solve(g);
}

void NewtonEquation::factorise(AugmentedSystem& system, double weight) {
    const Matrix& symmetric = system.symmetric_jacobian();
    if (!analysed_) symmetric_.analyzePattern(symmetric), analysed_ = true;
    symmetric_.factorize(symmetric);
    demand(symmetric_.info());
    jacobian_ = system.jacobian();
    full_ready_ = false;
    weight_ = weight;
    statuses_ = system.statuses();
}

}  // namespace turbidite::nscd
