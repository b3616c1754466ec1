// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/fourier_rows.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

using std::numbers::pi;

[[noreturn]] void no_plan(int length) {
    throw std::runtime_error("FFTW could not create a plan for rows of " + std::to_string(length));
}

struct Complex {
    double re, im;
};

/// FFTW's complex transforms of one length, out of place, between two arrays that the caller fills
/// and reads.
class ComplexPlans {
 public:
    explicit ComplexPlans(int length) : in(allocated(length)), out(allocated(length)) {
        auto* from = reinterpret_cast<fftw_complex*>(in);
        auto* to = reinterpret_cast<fftw_complex*>(out);
        there_ = fftw_plan_dft_1d(length, from, to, FFTW_FORWARD, FFTW_ESTIMATE);
        back_ = fftw_plan_dft_1d(length, from, to, FFTW_BACKWARD, FFTW_ESTIMATE);
        if (!there_ || !back_) no_plan(length);
    }
    ~ComplexPlans() {
        fftw_destroy_plan(there_);
        fftw_destroy_plan(back_);
        fftw_free(in);
        fftw_free(out);
    }
    ComplexPlans(const ComplexPlans&) = delete;

    void forward() { fftw_execute(there_); }
    void backward() { fftw_execute(back_); }

    Complex* const in;
    Complex* const out;

 private:
    static Complex* allocated(int length) {
        auto* values = static_cast<Complex*>(fftw_malloc(sizeof(Complex) * length));
        if (!values) throw std::bad_alloc();
        std::fill_n(values, length, Complex{0.0, 0.0});
        return values;
    }
    fftw_plan there_, back_;
};

/// exp(-i angle) at `count` angles first + k step.
std::vector<Complex> turns(int count, double first, double step) {
    std::vector<Complex> result;
    for (int k = 0; k < count; ++k)
        result.push_back({std::cos(first + k * step), -std::sin(first + k * step)});
    return result;
}

/// Periodic ends: R2HC, HC2R.
class Periodic final : public RowTransform::Kind {
 public:
    explicit Periodic(int n) : n_(n), plans_(n) {}

    void forward(double* a, double* b) override {
        // z = a + ib
        for (int j = 0; j < n_; ++j) plans_.in[j] = {a[j], b[j]};
        plans_.forward();
        const Complex* Z = plans_.out;
        a[0] = Z[0].re;
        b[0] = Z[0].im;
        for (int k = 1; 2 * k <= n_; ++k) {
            // With p = Z_k and q = Z_{n-k}: A_k = (p + conj q)/2, B_k = (p - conj q)/2i. R2HC has
            // the real part at k and the imaginary part at n - k.
            const Complex p = Z[k], q = Z[n_ - k];
            a[n_ - k] = 0.5 * (p.im - q.im);
            b[n_ - k] = 0.5 * (q.re - p.re);
            a[k] = 0.5 * (p.re + q.re);  // last: where k = n - k there is only a real part
            b[k] = 0.5 * (p.im + q.im);
        }
    }

    void backward(double* a, double* b) override {
        Complex* Z = plans_.in;
        Z[0] = {a[0], b[0]};
        for (int k = 1; 2 * k < n_; ++k) {
            // Z_k = A_k + i B_k, Z_{n-k} = conj A_k + i conj B_k
            Z[k] = {a[k] - b[n_ - k], a[n_ - k] + b[k]};
            Z[n_ - k] = {a[k] + b[n_ - k], b[k] - a[n_ - k]};
        }
        // k = n - k: real parts alone
        if (n_ % 2 == 0) Z[n_ / 2] = {a[n_ / 2], b[n_ / 2]};
        plans_.backward();
        for (int j = 0; j < n_; ++j) {
            a[j] = plans_.out[j].re;
            b[j] = plans_.out[j].im;
        }
    }

 private:
    int n_;
    ComplexPlans plans_;
};

/// Equal ends: REDFT10, REDFT01; with `odd` RODFT10, RODFT01.
template <bool odd>
class SameEnds final : public RowTransform::Kind {
 public:
    explicit SameEnds(int n) : n_(n), plans_(n), turns_(turns(n / 2 + 1, 0.0, 0.5 * pi / n)) {}

    void forward(double* a, double* b) override {
        reorder(a, b);
        plans_.forward();
        const Complex* Z = plans_.out;
        // k = 0 has no partner: A_0 is the real part of Z_0, B_0 the imaginary one.
        a[mode(0)] = 2.0 * Z[0].re;
        b[mode(0)] = 2.0 * Z[0].im;
        for (int k = 1; 2 * k <= n_; ++k) {
            const Complex p = Z[k], q = Z[n_ - k], w = turns_[k];
            // 2 A_k and 2 B_k; X_k = 2 Re(w A_k), X_{n-k} = -2 Im(w A_k)
            const Complex A{p.re + q.re, p.im - q.im}, B{p.im + q.im, q.re - p.re};
            a[mode(n_ - k)] = -(w.re * A.im + w.im * A.re);
            b[mode(n_ - k)] = -(w.re * B.im + w.im * B.re);
            a[mode(k)] = w.re * A.re - w.im * A.im;
            b[mode(k)] = w.re * B.re - w.im * B.im;
        }
    }

    void backward(double* a, double* b) override {
        Complex* Z = plans_.in;
        Z[0] = {a[mode(0)], b[mode(0)]};
        for (int k = 1; 2 * k <= n_; ++k) {
            const Complex w = turns_[k];
            // conj(w) (X_k - i X_{n-k}) = 2 A_k, and Z = A + iB again. The factor 2 is part of the
            // normalisation 2n.
            const Complex A = unturned(a, k, w), B = unturned(b, k, w);
            Z[n_ - k] = {A.re + B.im, B.re - A.im};
            Z[k] = {A.re - B.im, A.im + B.re};
        }
        plans_.backward();
        restore(a, b);
    }

 private:
    /// Where mode k of the cosine transform is stored.
    int mode(int k) const { return odd ? n_ - 1 - k : k; }

    /// Undoes the factor w: conj(w) (X_k - i X_{n-k}).
    Complex unturned(const double* x, int k, Complex w) const {
        const double even_part = x[mode(k)], odd_part = x[mode(n_ - k)];
        return {w.re * even_part - w.im * odd_part, -w.im * even_part - w.re * odd_part};
    }

    void reorder(const double* a, const double* b) {
        constexpr double sign = odd ? -1.0 : 1.0;
        // Even places ascending, then odd ones descending; signs of odd places for DST-II
        for (int j = 0; 2 * j < n_; ++j) plans_.in[j] = {a[2 * j], b[2 * j]};
        for (int j = 0; 2 * j + 1 < n_; ++j)
            plans_.in[n_ - 1 - j] = {sign * a[2 * j + 1], sign * b[2 * j + 1]};
    }

    void restore(double* a, double* b) const {
        constexpr double sign = odd ? -1.0 : 1.0;
        for (int j = 0; 2 * j < n_; ++j) {
            a[2 * j] = plans_.out[j].re;
            b[2 * j] = plans_.out[j].im;
        }
        for (int j = 0; 2 * j + 1 < n_; ++j) {
            a[2 * j + 1] = sign * plans_.out[n_ - 1 - j].re;
            b[2 * j + 1] = sign * plans_.out[n_ - 1 - j].im;
        }
    }

    int n_;
    ComplexPlans plans_;
    std::vector<Complex> turns_;
};

/// Mixed ends: REDFT11; with `odd` RODFT11. n must be even.
template <bool odd>
class MixedEnds final : public RowTransform::Kind {
 public:
    explicit MixedEnds(int n)
        : n_(n), plans_(n / 2), turns_(turns(n / 2, 0.125 * pi / n, pi / n)) {}

    void forward(double* a, double* b) override {
        one_row(a);
        one_row(b);
    }
    void backward(double* a, double* b) override { forward(a, b); }  // its own inverse

 private:
    static Complex product(Complex x, Complex y) {
        return {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};
    }

    void one_row(double* x) {
        for (int j = 0; j < n_ / 2; ++j) {
            // z_j = (x_2j + i x_{n-1-2j}) t_j, of a row that is reversed for DST-IV
            const Complex z =
                odd ? Complex{x[n_ - 1 - 2 * j], x[2 * j]} : Complex{x[2 * j], x[n_ - 1 - 2 * j]};
            plans_.in[j] = product(z, turns_[j]);
        }
        plans_.forward();
        for (int k = 0; k < n_ / 2; ++k) {
            // X_2k - i X_{n-1-2k} = 2 t_k Z_k
            const Complex y = product(plans_.out[k], turns_[k]);
            x[2 * k] = 2.0 * y.re;
            x[n_ - 1 - 2 * k] = odd ? 2.0 * y.im : -2.0 * y.im;  // the sign of odd modes
        }
    }

    int n_;
    ComplexPlans plans_;
    std::vector<Complex> turns_;
};

/// FFTW's own real plan, which is its own inverse.
class RealRow final : public RowTransform::Kind {
 public:
    RealRow(int n, fftw_r2r_kind kind) : row_(n) {
        plan_ = fftw_plan_r2r_1d(n, row_.data(), row_.data(), kind, FFTW_ESTIMATE | FFTW_UNALIGNED);
        if (!plan_) no_plan(n);
    }
    ~RealRow() override { fftw_destroy_plan(plan_); }

    void forward(double* a, double* b) override {
        fftw_execute_r2r(plan_, a, a);
        fftw_execute_r2r(plan_, b, b);
    }
    void backward(double* a, double* b) override { forward(a, b); }

 private:
    std::vector<double> row_;
    fftw_plan plan_;
};

}  // namespace

std::unique_ptr<RowTransform::Kind> make_row_kind(const AxisOperator& axis) {
    const int n = axis.cells;
    const auto ends = [&](End lower, End upper) {
        return axis.lower == lower && axis.upper == upper;
    };
    if (ends(End::periodic, End::periodic)) return std::make_unique<Periodic>(n);
    if (ends(End::neumann, End::neumann)) return std::make_unique<SameEnds<false>>(n);
    if (ends(End::dirichlet, End::dirichlet)) return std::make_unique<SameEnds<true>>(n);
    if (ends(End::neumann, End::dirichlet)) {
        if (n % 2 == 1) return std::make_unique<RealRow>(n, FFTW_REDFT11);
        return std::make_unique<MixedEnds<false>>(n);
    }
    if (ends(End::dirichlet, End::neumann)) {
        if (n % 2 == 1) return std::make_unique<RealRow>(n, FFTW_RODFT11);
        return std::make_unique<MixedEnds<true>>(n);
    }
    throw std::invalid_argument("there is no transform for this pair of ends");
}

}  // namespace turbidite
