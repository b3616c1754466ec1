// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/boxOperator.hpp"

#include <cyclicLduInterface.H>
#include <cyclicLduInterfaceField.H>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace turbidite {
namespace {

constexpr const char* axis_names[] = {"x", "y"};

/// Sums of a row's coefficients round to this share of its diagonal.
constexpr double rounding = 1e-13;

/// What the matrix says about itself, multiplied by its sign.
struct Reading {
    double sign = 1.0;
    std::array<double, 2> mean{};  // c of each axis
    std::array<bool, 2> cyclic{};  // axis closed
    std::vector<double> excess;    // of the diagonal, by place
    double noise = 0.0;            // of the excess
    int reference = -1;            // place
    double stiffening = 0.0;

    double total() const {
        double sum = 0.0;
        for (double value : excess) sum += value;
        return sum;
    }
};

std::string number(double value) {
    std::ostringstream text;
    text.precision(9);
    text << value;
    return text.str();
}

std::string cell_name(const BoxNumbering& box, int place) {
    const auto cell = std::find(box.place.begin(), box.place.end(), place) - box.place.begin();
    return "cell " + std::to_string(cell) + " (column " + std::to_string(place % box.cells[0]) +
           ", row " + std::to_string(place / box.cells[0]) + ")";
}

/// The axis whose two ends the cells are.
int closed_axis(const BoxNumbering& box, int a, int b) {
    const int columns = std::abs(box.column(a) - box.column(b));
    const int rows = std::abs(box.row(a) - box.row(b));
    if (rows == 0 && columns == box.cells[0] - 1) return 0;
    if (columns == 0 && rows == box.cells[1] - 1) return 1;
    throw DoesNotFit("a cyclic patch joins cells " + std::to_string(a) + " and " +
                     std::to_string(b) + ", which are not opposite each other");
}

const Foam::cyclicLduInterface& checked_cyclic(const Foam::lduInterfaceField& field) {
    const auto* interface = dynamic_cast<const Foam::cyclicLduInterface*>(&field.interface());
    if (!interface) throw DoesNotFit("a patch field of type " + field.type() + " couples cells");
    const auto* turning = dynamic_cast<const Foam::cyclicLduInterfaceField*>(&field);
    if (turning && turning->doTransform() && turning->rank() > 0)
        throw DoesNotFit("a cyclic patch turns vectors");
    return *interface;
}

/// Calls visit(axis, a, A_ab) for each coefficient of a row a that belongs to a cyclic patch;
/// returns how many there are across each axis.
template <class Visit>
std::array<int, 2> for_each_cyclic(const SolverMatrix& system, const BoxNumbering& box,
                                   Visit visit) {
    std::array<int, 2> count{};
    forAll(system.interfaces, patch) {
        if (!system.interfaces.set(patch)) continue;
        const Foam::lduInterfaceField& field = system.interfaces[patch];
        const Foam::label across = checked_cyclic(field).neighbPatchID();
        const Foam::labelUList& cells = system.matrix.lduAddr().patchAddr(patch);
        const Foam::labelUList& others = system.matrix.lduAddr().patchAddr(across);
        forAll(cells, face) {
            const int axis = closed_axis(box, cells[face], others[face]);
            ++count[axis];
            visit(axis, cells[face], -system.boundary[patch][face]);
        }
    }
    return count;
}

/// Calls visit(axis, a, b, A_ab) for each coefficient above the diagonal.
template <class Visit>
void for_each_inner(const SolverMatrix& system, const BoxNumbering& box, Visit visit) {
    const Foam::scalarField& upper = system.matrix.upper();
    const Foam::labelUList& low = system.matrix.lduAddr().lowerAddr();
    const Foam::labelUList& high = system.matrix.lduAddr().upperAddr();
    forAll(upper, face) visit(box.axis[face], low[face], high[face], upper[face]);
}

void read_means(const SolverMatrix& system, const BoxNumbering& box, Reading& reading) {
    std::array<double, 2> sum{};
    std::array<int, 2> faces{};
    for_each_inner(system, box, [&](int axis, int, int, double value) {
        sum[axis] -= value;
        ++faces[axis];
    });
    const auto closed = for_each_cyclic(system, box, [](int, int, double) {});
    for (int axis = 0; axis < 2; ++axis) {
        if (closed[axis] != 0 && closed[axis] != 2 * box.cells[1 - axis])
            throw DoesNotFit(std::string("cyclic patches cover a part of the sides across ") +
                             axis_names[axis]);
        reading.cyclic[axis] = closed[axis] != 0;
        reading.mean[axis] = sum[axis] / faces[axis];
    }
    if (!(reading.mean[0] * reading.mean[1] > 0.0) || !std::isfinite(sum[0] + sum[1]))
        throw DoesNotFit("its coefficients are " + number(reading.mean[0]) + " along x and " +
                         number(reading.mean[1]) + " along y in the mean, not of one sign");
    reading.sign = reading.mean[0] > 0.0 ? 1.0 : -1.0;
    for (double& mean : reading.mean) mean *= reading.sign;
}

void read_excess(const SolverMatrix& system, const BoxNumbering& box, Reading& reading) {
    const double s = reading.sign;
    std::vector<double>& excess = reading.excess;
    excess.resize(box.place.size());
    double largest = 0.0;
    for (std::size_t c = 0; c < box.place.size(); ++c) {
        excess[box.place[c]] = s * system.matrix.diag()[c];
        largest = std::max(largest, std::abs(excess[box.place[c]]));
    }
    for_each_inner(system, box, [&](int, int low, int high, double value) {
        excess[box.place[low]] += s * value;
        excess[box.place[high]] += s * value;
    });
    for_each_cyclic(system, box,
                    [&](int, int cell, double value) { excess[box.place[cell]] += s * value; });
    reading.noise = rounding * largest;
}

/// The one cell with an excess, where all others have none.
void take_reference(Reading& reading) {
    const auto more = [&](double value) { return value > reading.noise; };
    const auto first = std::find_if(reading.excess.begin(), reading.excess.end(), more);
    if (first == reading.excess.end()) return;
    if (std::find_if(first + 1, reading.excess.end(), more) != reading.excess.end()) return;
    reading.reference = first - reading.excess.begin();
    reading.stiffening = *first;
    *first = 0.0;
}

Reading read(const SolverMatrix& system, const BoxNumbering& box) {
    Reading reading;
    read_means(system, box, reading);
    read_excess(system, box, reading);
    take_reference(reading);
    return reading;
}

/// Mean of the excess over places [i0, i1) x [j0, j1).
double mean_excess(const Reading& reading, const BoxNumbering& box, int i0, int i1, int j0,
                   int j1) {
    double sum = 0.0;
    for (int j = j0; j < j1; ++j)
        for (int i = i0; i < i1; ++i) sum += reading.excess[i + j * box.cells[0]];
    return sum / ((i1 - i0) * (j1 - j0));
}

/// Without the corners, which belong to two sides.
double mean_of_side(const Reading& reading, const BoxNumbering& box, int axis, bool high) {
    const int nx = box.cells[0], ny = box.cells[1];
    const int at = high ? box.cells[axis] - 1 : 0;
    return axis == 0 ? mean_excess(reading, box, at, at + 1, 1, ny - 1)
                     : mean_excess(reading, box, 1, nx - 1, at, at + 1);
}

End end_of(const Reading& reading, const BoxNumbering& box, double alpha, int axis, bool high) {
    if (reading.cyclic[axis]) return End::periodic;
    const double share = mean_of_side(reading, box, axis, high) - alpha;
    return share > reading.mean[axis] ? End::dirichlet : End::neumann;
}

BoxOperator operator_of(const Reading& reading, const BoxNumbering& box) {
    const int nx = box.cells[0], ny = box.cells[1];
    double alpha = mean_excess(reading, box, 1, nx - 1, 1, ny - 1);
    if (std::abs(alpha) <= reading.noise) alpha = 0.0;
    const auto end = [&](int axis, bool high) { return end_of(reading, box, alpha, axis, high); };
    BoxOperator found;
    found.sign = reading.sign;
    found.plane.x = {nx, 1.0, end(0, false), end(0, true)};
    found.plane.y = {ny, std::sqrt(reading.mean[0] / reading.mean[1]), end(1, false), end(1, true)};
    found.problem = {alpha, reading.mean[0]};
    found.reference = reading.reference;
    found.stiffening = reading.stiffening;
    return found;
}

void check_coefficients(const SolverMatrix& system, const BoxNumbering& box,
                        const Reading& reading) {
    const auto check_one = [&](int axis, int cell, double value) {
        const double expected = -reading.sign * reading.mean[axis];
        if (std::abs(value - expected) <= coefficient_tolerance * reading.mean[axis]) return;
        throw DoesNotFit(std::string("the coefficients along ") + axis_names[axis] +
                         " are not all equal: " + number(value) + " at " +
                         cell_name(box, box.place[cell]) + ", " + number(expected) +
                         " in the mean");
    };
    for_each_inner(system, box,
                   [&](int axis, int low, int, double value) { check_one(axis, low, value); });
    for_each_cyclic(system, box, check_one);
}

/// alpha + 2 c for each side at this place that holds a value.
double expected_excess(const BoxOperator& found, const Reading& reading, int i, int j) {
    const AxisOperator& x = found.plane.x;
    const AxisOperator& y = found.plane.y;
    const auto holds = [](const AxisOperator& axis, int at) {
        return (at == 0 && axis.lower == End::dirichlet) +
               (at == axis.cells - 1 && axis.upper == End::dirichlet);
    };
    return found.problem.alpha + 2.0 * reading.mean[0] * holds(x, i) +
           2.0 * reading.mean[1] * holds(y, j);
}

void check_diagonal(const BoxOperator& found, const Reading& reading, const BoxNumbering& box) {
    if (found.problem.alpha < 0.0)
        throw DoesNotFit(
            "its diagonal is smaller than the sum of its neighbours' coefficients, by " +
            number(-found.problem.alpha));
    const int count = box.cells[0] * box.cells[1];
    for (int place = 0; place < count; ++place) {
        const double expected =
            expected_excess(found, reading, place % box.cells[0], place / box.cells[0]);
        const double off = reading.excess[place] - expected;
        if (std::abs(off) <= coefficient_tolerance * expected + reading.noise) continue;
        throw DoesNotFit("the diagonal at " + cell_name(box, place) +
                         " exceeds its neighbours by " + number(reading.excess[place]) + " where " +
                         number(expected) + " would fit a side of one condition (" +
                         number(found.problem.alpha) + " inside, plus " +
                         number(2.0 * reading.mean[0]) + " or " + number(2.0 * reading.mean[1]) +
                         " for a value held at a side)");
    }
}

}  // namespace

BoxOperator exact_operator(const SolverMatrix& system, const BoxNumbering& box) {
    const Reading reading = read(system, box);
    check_coefficients(system, box, reading);
    const BoxOperator found = operator_of(reading, box);
    check_diagonal(found, reading, box);
    return found;
}

BoxOperator nearest_operator(const SolverMatrix& system, const BoxNumbering& box) {
    const Reading reading = read(system, box);
    BoxOperator found = operator_of(reading, box);
    found.problem.alpha = std::max(found.problem.alpha, 0.0);
    // A few faces may hold a value where their side as a whole does not. Then constants are not
    // free in A and must not be here: 1.A1 is kept instead.
    const double per_cell = reading.total() / reading.excess.size();
    if (found.floating() && found.reference < 0 && per_cell > reading.noise)
        found.problem.alpha = per_cell;
    return found;
}

}  // namespace turbidite
