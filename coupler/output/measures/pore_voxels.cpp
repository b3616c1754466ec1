// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/pore_voxels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace turbidite {
namespace {

constexpr double voxels_per_diameter = 8.0;
// Squared distances are whole numbers of 1/16 squared voxel, up to three times `farthest` squared.
constexpr double fractions = 16.0;
constexpr std::int64_t farthest = 10;  // [voxels], above D and what it is rounded by
// Above 3 x 16 x 10^2 = 4800, and small enough that 20000 and a square of 10 steps fit 16 bits.
constexpr std::int16_t far_away = 20000;

std::int16_t square_of(double distance) {
    // [1/16 squared step along x]
    return static_cast<std::int16_t>(std::lround(fractions * distance * distance));
}

/// Where the voxels of a box around the balls lie; along cyclic axes a whole number of them is the
/// period.
class Lattice {
 public:
    Lattice(const std::vector<SolidBall>& balls, double diameter, const Vec3& period)
        : periodic_{period[0] > 0.0, period[1] > 0.0, period[2] > 0.0} {
        // Beyond an empty ball that touches the outermost grain nothing is shut in.
        const double margin = 2.5 * diameter;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [low, high] = extent(balls, axis);
            const double length = periodic_[axis] ? period[axis] : high - low + 2.0 * margin;
            const double edge = diameter / voxels_per_diameter;
            count_[axis] = std::max<std::int64_t>(1, std::llround(length / edge));
            // A whole number of voxels is the period; D/8 elsewhere.
            edge_[axis] = periodic_[axis] ? length / static_cast<double>(count_[axis]) : edge;
            // Around the middle of the balls: their mirror image has the same pores.
            const double covered = edge * static_cast<double>(count_[axis]);
            origin_[axis] = periodic_[axis] ? 0.0 : 0.5 * (low + high - covered);
        }
        across_ = diameter / edge_[0];
    }

    std::int64_t count(std::size_t axis) const { return count_[axis]; }
    bool periodic(std::size_t axis) const { return periodic_[axis]; }
    double volume() const { return edge_[0] * edge_[1] * edge_[2]; }

    /// Steps along an axis in those along x: edges of cyclic axes differ by a few percent at most.
    double scale(std::size_t axis) const { return edge_[axis] / edge_[0]; }
    /// D in steps along x.
    double across() const { return across_; }

    Vec3 centre(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return {origin_[0] + (static_cast<double>(i) + 0.5) * edge_[0],
                origin_[1] + (static_cast<double>(j) + 0.5) * edge_[1],
                origin_[2] + (static_cast<double>(k) + 0.5) * edge_[2]};
    }

    /// The first and the last voxel along an axis whose centre may be in a ball, not wrapped.
    std::array<std::int64_t, 2> covered(const SolidBall& ball, std::size_t axis) const {
        // In indices, of which i is the centre of voxel i.
        const double at = (ball.centre[axis] - origin_[axis]) / edge_[axis] - 0.5;
        const double reach = ball.radius / edge_[axis];
        return {static_cast<std::int64_t>(std::ceil(at - reach)),
                static_cast<std::int64_t>(std::floor(at + reach))};
    }

 private:
    static std::array<double, 2> extent(const std::vector<SolidBall>& balls, std::size_t axis) {
        double low = INFINITY, high = -INFINITY;
        for (const SolidBall& ball : balls) {
            low = std::min(low, ball.centre[axis] - ball.radius);
            high = std::max(high, ball.centre[axis] + ball.radius);
        }
        return {low, high};
    }

    std::array<bool, 3> periodic_;
    std::array<std::int64_t, 3> count_{};
    Vec3 edge_{}, origin_{};
    double across_ = voxels_per_diameter;
};

std::int64_t modulo(std::int64_t i, std::int64_t n) {
    return ((i % n) + n) % n;
}

/// The voxels of a piece along one axis, [counted_from, counted_to), and those around them that
/// decide about them, [low, high): whether one is a pore depends on voxels up to two transforms
/// away.
class Stretch {
 public:
    static constexpr std::int64_t decides = 2 * farthest;

    Stretch() = default;
    /// Of `count` voxels in all.
    Stretch(std::int64_t from, std::int64_t to, std::int64_t count, bool periodic)
        : counted_from(from), counted_to(to), count_(count), periodic_(periodic) {
        low = is_whole_period() ? from : from - decides;
        high = is_whole_period() ? to : to + decides;
        if (!periodic_) low = std::max<std::int64_t>(low, 0), high = std::min(high, count);
    }

    bool is_whole_period() const { return periodic_ && counted_to - counted_from == count_; }
    std::int64_t size() const { return high - low; }

    /// From `low` on; along a cyclic axis that of its images which is here, if one is.
    std::int64_t place(std::int64_t i) const {
        return periodic_ ? modulo(i - low, count_) : i - low;
    }
    bool has(std::int64_t i) const {
        const std::int64_t at = place(i);
        return at >= 0 && at < size();
    }
    bool meets(const std::array<std::int64_t, 2>& covered) const {
        const auto [first, last] = covered;
        if (!periodic_) return first < high && last >= low;
        return has(first) || place(first) + last - first >= count_;
    }

    /// Leaves out what is too far from [first, last] to decide anything.
    void crop(std::int64_t first, std::int64_t last) {
        if (periodic_) return;
        low = std::max(low, first - decides);
        high = std::min(high, last + 1 + decides);
        counted_from = std::max(counted_from, low);
        counted_to = std::min(counted_to, high);
    }

    std::int64_t counted_from = 0, counted_to = 0, low = 0, high = 0;

 private:
    std::int64_t count_ = 0;
    bool periodic_ = false;
};

/// The balls of a piece of the lattice on its voxels.
class Voxels {
 public:
    Voxels(const Lattice& lattice, std::array<Stretch, 3> piece,
           const std::vector<const SolidBall*>& balls)
        : lattice_(&lattice), along_(piece) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::int64_t first = along_[axis].high, last = along_[axis].low;
            for (const SolidBall* ball : balls) {
                const auto [from, to] = lattice.covered(*ball, axis);
                first = std::min(first, from), last = std::max(last, to);
            }
            along_[axis].crop(first, last);
        }
    }

    std::int64_t count(std::size_t axis) const { return along_[axis].size(); }
    std::size_t size() const { return static_cast<std::size_t>(count(0) * count(1) * count(2)); }
    bool periodic(std::size_t axis) const { return along_[axis].is_whole_period(); }
    double scale(std::size_t axis) const { return lattice_->scale(axis); }

    /// Of the neighbour one step further along an axis.
    std::size_t stride(std::size_t axis) const {
        const std::int64_t steps[] = {1, count(0), count(0) * count(1)};
        return static_cast<std::size_t>(steps[axis]);
    }

    /// Calls visit(index) for the voxels whose centre is in a ball.
    template <class Visit>
    void each_in(const SolidBall& ball, Visit visit) const {
        const auto [i0, i1] = lattice_->covered(ball, 0);
        const auto [j0, j1] = lattice_->covered(ball, 1);
        const auto [k0, k1] = lattice_->covered(ball, 2);
        for (std::int64_t k = k0; k <= k1; ++k) {
            if (!along_[2].has(k)) continue;
            for (std::int64_t j = j0; j <= j1; ++j) {
                if (!along_[1].has(j)) continue;
                for (std::int64_t i = i0; i <= i1; ++i) {
                    const Vec3 arm = lattice_->centre(i, j, k) - ball.centre;
                    if (dot(arm, arm) <= ball.radius * ball.radius && along_[0].has(i))
                        visit(index(i, j, k));
                }
            }
        }
    }

    /// Calls visit(index) for the voxels that are counted.
    template <class Visit>
    void each_counted(Visit visit) const {
        const auto& [x, y, z] = along_;
        for (std::int64_t k = z.counted_from; k < z.counted_to; ++k)
            for (std::int64_t j = y.counted_from; j < y.counted_to; ++j) {
                const std::size_t row = index(x.counted_from, j, k);
                for (std::int64_t i = 0; i < x.counted_to - x.counted_from; ++i)
                    visit(row + static_cast<std::size_t>(i));
            }
    }

 private:
    std::size_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return static_cast<std::size_t>(
            along_[0].place(i) + count(0) * (along_[1].place(j) + count(1) * along_[2].place(k)));
    }

    const Lattice* lattice_;
    std::array<Stretch, 3> along_;
};

/// Where `other` plus a number is less, that.
void lower(std::int16_t* result, const std::int16_t* other, std::size_t size, std::int16_t added) {
    for (std::size_t i = 0; i < size; ++i) {
        const auto sum = static_cast<std::int16_t>(other[i] + added);
        result[i] = sum < result[i] ? sum : result[i];
    }
}

/// Replaces squares along an axis by min over k of f(q + k) + s^2 k^2. Axis by axis this gives the
/// squared distance from the nearest site, exactly where it is at most `farthest` steps.
class AxisTransform {
 public:
    AxisTransform(const Voxels& voxels, std::size_t axis)
        : row_(static_cast<std::size_t>(axis == 0 ? 1 : voxels.stride(axis))),
          count_(voxels.count(axis)),
          periodic_(voxels.periodic(axis)) {
        for (std::int64_t k = 0; k <= farthest; ++k)
            added_[static_cast<std::size_t>(k)] =
                square_of(static_cast<double>(k) * voxels.scale(axis));
    }

    /// From and to the same place of two arrays: all positions of an axis, of which each is a row
    /// of neighbours across it. Rows are cut so that those within reach stay in the cache.
    void operator()(const std::int16_t* from, std::int16_t* to) const {
        constexpr std::size_t piece = 2048;
        for (std::size_t first = 0; first < row_; first += piece)
            transform(from + first, to + first, std::min(piece, row_ - first));
    }

    std::size_t span() const { return row_ * static_cast<std::size_t>(count_); }

 private:
    void transform(const std::int16_t* from, std::int16_t* to, std::size_t size) const {
        for (std::int64_t q = 0; q < count_; ++q) {
            std::int16_t* result = to + at(q);
            std::copy_n(from + at(q), size, result);
            for (std::int64_t k = 1; k <= farthest; ++k)
                // Sites beyond a side that is not cyclic do not exist.
                for (const std::int64_t p : {q - k, q + k})
                    if (periodic_ || (p >= 0 && p < count_))
                        lower(result, from + at(wrapped(p)), size,
                              added_[static_cast<std::size_t>(k)]);
        }
    }
    std::size_t at(std::int64_t q) const { return static_cast<std::size_t>(q) * row_; }
    std::int64_t wrapped(std::int64_t p) const { return ((p % count_) + count_) % count_; }

    std::size_t row_;
    std::int64_t count_;
    bool periodic_;
    std::array<std::int16_t, farthest + 1> added_{};
};

/// The transform along x, whose rows are lines themselves.
void transform_line(std::vector<std::int16_t>& padded, const std::int16_t* from, std::int16_t* to,
                    std::size_t count, bool periodic) {
    constexpr std::size_t reach = farthest;
    padded.assign(count + 2 * reach, far_away);
    std::copy_n(from, count, padded.begin() + farthest);
    for (std::size_t i = 0; periodic && i < reach; ++i) {
        padded[reach - 1 - i] = from[count - 1 - i % count];
        padded[reach + count + i] = from[i % count];
    }
    std::copy_n(from, count, to);
    for (std::size_t k = 1; k <= reach; ++k)
        for (const std::size_t first : {reach - k, reach + k})
            lower(to, &padded[first], count, square_of(static_cast<double>(k)));
}

/// From 0 at sites and far_away elsewhere to squared distances from the nearest site.
void transform(std::vector<std::int16_t>& squares, const Voxels& voxels) {
    std::vector<std::int16_t> other(squares.size()), padded;
    const auto nx = static_cast<std::size_t>(voxels.count(0));
    for (std::size_t first = 0; first < squares.size(); first += nx)
        transform_line(padded, &squares[first], &other[first], nx, voxels.periodic(0));
    for (const std::size_t axis : {std::size_t{1}, std::size_t{2}}) {
        squares.swap(other);
        const AxisTransform along(voxels, axis);
        for (std::size_t first = 0; first < squares.size(); first += along.span())
            along(&squares[first], &other[first]);
    }
    squares.swap(other);
}

/// The pores among the voxels of a piece.
std::size_t pores_of(const Lattice& lattice, const std::array<Stretch, 3>& piece,
                     const std::vector<const SolidBall*>& balls) {
    const Voxels voxels(lattice, piece, balls);
    std::vector<std::uint8_t> solid(voxels.size(), 0);
    for (const SolidBall* ball : balls) voxels.each_in(*ball, [&](std::size_t i) { solid[i] = 1; });
    std::vector<std::int16_t> squares(voxels.size());
    std::transform(solid.begin(), solid.end(), squares.begin(),
                   [](std::uint8_t is) { return is ? std::int16_t{0} : far_away; });
    transform(squares, voxels);
    // A surface lies half a step beyond the outermost centres in it, on average.
    // (D + half a step)^2
    const std::int16_t limit = square_of(lattice.across() + 0.5);
    // The centres of empty balls of radius D become the sites of the second transform.
    for (std::int16_t& square : squares) square = square >= limit ? std::int16_t{0} : far_away;
    transform(squares, voxels);
    std::size_t pores = 0;
    voxels.each_counted([&](std::size_t i) { pores += !solid[i] && squares[i] > limit; });
    return pores;
}

/// An axis cut into stretches of equal length, of at most `longest`.
std::vector<Stretch> stretches(const Lattice& lattice, std::size_t axis, std::int64_t longest) {
    const std::int64_t count = lattice.count(axis);
    std::int64_t pieces = (count + longest - 1) / longest;
    // No stretch may have two images of a voxel.
    if (lattice.periodic(axis) && count / pieces + 1 + 2 * Stretch::decides > count) pieces = 1;
    std::vector<Stretch> found;
    for (std::int64_t n = 0; n < pieces; ++n)
        found.emplace_back(n * count / pieces, (n + 1) * count / pieces, count,
                           lattice.periodic(axis));
    return found;
}

/// Which stretches of an axis a ball reaches.
std::vector<std::size_t> reached_by(const SolidBall& ball, const Lattice& lattice,
                                    const std::vector<Stretch>& along, std::size_t axis) {
    std::vector<std::size_t> found;
    const auto covered = lattice.covered(ball, axis);
    for (std::size_t n = 0; n < along.size(); ++n)
        if (along[n].meets(covered)) found.push_back(n);
    return found;
}

}  // namespace

double pore_volume(const std::vector<SolidBall>& balls, double diameter, const Vec3& period,
                   std::int64_t longest_piece) {
    if (balls.empty()) return 0.0;
    const Lattice lattice(balls, diameter, period);
    std::array<std::vector<Stretch>, 3> along;
    for (std::size_t axis = 0; axis < 3; ++axis)
        along[axis] = stretches(lattice, axis, longest_piece);
    // Only pieces that balls reach.
    std::map<std::array<std::size_t, 3>, std::vector<const SolidBall*>> pieces;
    for (const SolidBall& ball : balls)
        for (const std::size_t i : reached_by(ball, lattice, along[0], 0))
            for (const std::size_t j : reached_by(ball, lattice, along[1], 1))
                for (const std::size_t k : reached_by(ball, lattice, along[2], 2))
                    pieces[{i, j, k}].push_back(&ball);
    std::size_t pores = 0;
    for (const auto& [at, near] : pieces)
        pores += pores_of(lattice, {along[0][at[0]], along[1][at[1]], along[2][at[2]]}, near);
    return static_cast<double>(pores) * lattice.volume();
}

}  // namespace turbidite
