// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/boxOperator.hpp"

#include <cyclicLduInterface.H>
#include <cyclicLduInterfaceField.H>
#include <processorLduInterface.H>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace turbidite {
namespace {

constexpr const char* axis_names[] = {"x", "y"};

/// The sum of a cell's coefficients is exact to this fraction of the diagonal.
constexpr double rounding = 1e-13;

/// Properties of the matrix, times its sign.
struct Reading {
    double sign = 1.0;
    std::array<double, 2> mean{};  // mean c of each axis
    std::array<bool, 2> cyclic{};  // whether the axis is closed
    std::vector<double> excess;    // of the diagonal over the neighbours, by cell of this rank
    double noise = 0.0;            // rounding error of the excess
    int reference = -1;            // place
    double stiffening = 0.0;
    double inside = 0.0;              // mean excess of the cells not at a side
    std::array<double, 4> at_side{};  // of those at left, right, bottom, top, without corners
    double everywhere = 0.0;          // of all cells
    std::vector<double> height;       // g_j, where rows differ; excess is then that over g_j

    double height_of(int row) const { return height.empty() ? 1.0 : height[row]; }
    /// What a value held at this side adds to the excess over g_j.
    double held(int side) const {
        const double h = side < 2 || height.empty() ? 1.0
                         : side == 2                ? height.front()
                                                    : height.back();
        // The side is half a cell away: 2 c_y/g_j instead of 2 c_y/(g_j + g_{j+1}), and over g_j.
        return 2.0 * mean[side / 2] / (h * h);
    }
    /// The coefficient between rows j and j + 1.
    double between_rows(int j) const { return 2.0 * mean[1] / (height_of(j) + height_of(j + 1)); }
};

std::string number(double value) {
    std::ostringstream text;
    text.precision(9);
    text << value;
    return text.str();
}

std::string cell_name(const BoxCells& box, int cell) {
    const int place = box.place[cell];
    return "cell " + std::to_string(cell) +
           (box.ranks.parallel() ? " of processor" + std::to_string(box.ranks.rank()) : "") +
           " (column " + std::to_string(box.column(place)) + ", row " +
           std::to_string(box.row(place)) + ")";
}

/// A coefficient of a patch that couples cells, in the equation of a cell of this rank.
struct PatchCoefficient {
    int cell;
    int beyond;  // place of the other cell
    double value;
    int axis;
    bool closes;  // the other cell is at the opposite end of the box, not the next one
};

/// The reason why the patch's coefficients cannot be read; empty if they can.
std::string fault_of(const Foam::lduInterfaceField& field) {
    if (!Foam::isA<Foam::cyclicLduInterface>(field.interface()) &&
        !Foam::isA<Foam::processorLduInterface>(field.interface()))
        return "a patch field of type " + field.type() + " couples cells";
    const auto* turning = dynamic_cast<const Foam::cyclicLduInterfaceField*>(&field);
    if (turning && turning->doTransform() && turning->rank() > 0)
        return "a cyclic patch rotates vectors";
    return {};
}

/// False if the two cells are neither neighbours nor opposite each other.
bool find_axis(const BoxCells& box, PatchCoefficient& found) {
    const int place = box.place[found.cell];
    const int columns = std::abs(box.column(place) - box.column(found.beyond));
    const int rows = std::abs(box.row(place) - box.row(found.beyond));
    found.axis = rows == 0 ? 0 : 1;
    const int apart = columns + rows;
    // From one end of the axis to the other
    found.closes = apart == box.cells[found.axis] - 1;
    return (columns == 0 || rows == 0) && (apart == 1 || found.closes);
}

std::vector<PatchCoefficient> patch_coefficients(const SolverMatrix& system, const BoxCells& box) {
    std::vector<PatchCoefficient> all;
    std::string fault;
    forAll(system.interfaces, patch) {
        if (!system.interfaces.set(patch)) continue;
        fault = fault.empty() ? fault_of(system.interfaces[patch]) : fault;
        if (!fault.empty()) break;
        const Foam::labelUList& cells = system.matrix.lduAddr().patchAddr(patch);
        forAll(cells, face) {
            // OpenFOAM subtracts boundary coefficients, so the entry of the matrix is minus that.
            PatchCoefficient found{cells[face], box.beyond[patch][face],
                                   -system.boundary[patch][face], 0, false};
            if (!find_axis(box, found))
                fault = "a cyclic patch joins " + cell_name(box, found.cell) +
                        " and a cell that is not opposite it";
            all.push_back(found);
        }
    }
    demand(box.ranks, fault);
    return all;
}

/// Calls visit(axis, a, b, A_ab) for each coefficient above the diagonal.
template <class Visit>
void for_each_inner(const SolverMatrix& system, const BoxCells& box, Visit visit) {
    const Foam::scalarField& upper = system.matrix.upper();
    const Foam::labelUList& low = system.matrix.lduAddr().lowerAddr();
    const Foam::labelUList& high = system.matrix.lduAddr().upperAddr();
    forAll(upper, face) visit(box.axis[face], low[face], high[face], upper[face]);
}

/// Sums over the coefficients of an axis, over all ranks.
struct AxisSum {
    double inner = 0.0, inner_faces = 0.0, closing_faces = 0.0;
};

/// A face between two ranks counts half on each.
std::array<AxisSum, 2> sum_axes(const SolverMatrix& system, const BoxCells& box,
                                const std::vector<PatchCoefficient>& patches) {
    std::array<AxisSum, 2> sums{};
    for_each_inner(system, box, [&](int axis, int, int, double value) {
        // Entries are -s c.
        sums[axis].inner -= value;
        ++sums[axis].inner_faces;
    });
    for (const PatchCoefficient& of : patches) {
        AxisSum& sum = sums[of.axis];
        if (of.closes) ++sum.closing_faces;
        if (!of.closes) sum.inner -= 0.5 * of.value;
        if (!of.closes) sum.inner_faces += 0.5;
    }
    static_assert(sizeof sums == 6 * sizeof(double));
    box.ranks.sum(&sums[0].inner, 6);
    return sums;
}

void read_means(const SolverMatrix& system, const BoxCells& box,
                const std::vector<PatchCoefficient>& patches, Reading& reading) {
    const std::array<AxisSum, 2> sums = sum_axes(system, box, patches);
    for (int axis = 0; axis < 2; ++axis) {
        const double closing = sums[axis].closing_faces;
        // Each face of a cyclic side is found from both ends.
        if (closing != 0.0 && closing != 2 * box.cells[1 - axis])
            throw DoesNotFit(std::string("cyclic patches cover only part of the sides normal to ") +
                             axis_names[axis]);
        reading.cyclic[axis] = closing != 0.0;
        reading.mean[axis] = sums[axis].inner / sums[axis].inner_faces;
    }
    if (!(reading.mean[0] * reading.mean[1] > 0.0) || !std::isfinite(sums[0].inner + sums[1].inner))
        throw DoesNotFit("its coefficients are " + number(reading.mean[0]) + " along x and " +
                         number(reading.mean[1]) +
                         " along y on average; they must have the same sign");
    reading.sign = reading.mean[0] > 0.0 ? 1.0 : -1.0;
    for (double& mean : reading.mean) mean *= reading.sign;
}

/// Means of the coefficients along x by row, and along y by the lower of two rows.
struct RowMeans {
    std::vector<double> along, across;
};

RowMeans row_means(const SolverMatrix& system, const BoxCells& box,
                   const std::vector<PatchCoefficient>& patches, double sign) {
    const int ny = box.cells[1];
    std::vector<double> sums(4 * static_cast<std::size_t>(ny), 0.0);  // two sums, two counts
    const auto add = [&](int axis, int a, int b, double value, double share) {
        const std::size_t at = axis * ny + std::min(box.row(a), box.row(b));
        sums[at] += share * sign * value;
        sums[at + 2 * ny] += share;
    };
    for_each_inner(system, box, [&](int axis, int low, int high, double value) {
        add(axis, box.place[low], box.place[high], -value, 1.0);
    });
    for (const PatchCoefficient& of : patches)
        if (!of.closes) add(of.axis, box.place[of.cell], of.beyond, -of.value, 0.5);
    box.ranks.sum(sums.data(), static_cast<int>(sums.size()));
    const auto mean = [&](int at) { return sums[at] / sums[at + 2 * ny]; };
    RowMeans means;
    for (int j = 0; j < ny; ++j) means.along.push_back(mean(j));
    for (int j = 0; j + 1 < ny; ++j) means.across.push_back(mean(ny + j));
    return means;
}

bool are_equal(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return *most - *least <= coefficient_tolerance * std::abs(*most);
}

double most_frequent(std::vector<double> values) {
    // The longest run of values that are equal to coefficient_tolerance
    std::sort(values.begin(), values.end());
    double found = values[0];
    for (std::size_t j = 0, longest = 0; j < values.size();) {
        const std::size_t from = j;
        while (j < values.size() && values[j] <= (1.0 + coefficient_tolerance) * values[from]) ++j;
        if (j - from > longest) found = values[from];
        longest = std::max(longest, j - from);
    }
    return found;
}

/// Heights of the rows over the most frequent one, if they differ; means of the axes are then those
/// of the latter, and the excess is divided by the heights.
void read_heights(const SolverMatrix& system, const BoxCells& box,
                  const std::vector<PatchCoefficient>& patches, Reading& reading) {
    const RowMeans rows = row_means(system, box, patches, reading.sign);
    if (reading.cyclic[1] || (are_equal(rows.along) && are_equal(rows.across))) return;
    // c along x is g_j c_x
    const double reference = most_frequent(rows.along);
    for (const double along : rows.along) {
        const double height = along / reference;
        const bool is_reference = std::abs(height - 1.0) <= coefficient_tolerance;
        reading.height.push_back(is_reference ? 1.0 : height);
    }
    double sum = 0.0;
    for (std::size_t j = 0; j < rows.across.size(); ++j)
        // c_y of each pair of rows, from 2 c_y/(g_j + g_{j+1})
        sum += 0.5 * (reading.height[j] + reading.height[j + 1]) * rows.across[j];
    reading.mean = {reference, sum / static_cast<double>(rows.across.size())};
}

void read_excess(const SolverMatrix& system, const BoxCells& box,
                 const std::vector<PatchCoefficient>& patches, Reading& reading) {
    const double s = reading.sign;
    std::vector<double>& excess = reading.excess;
    excess.resize(box.place.size());
    double largest = 0.0;
    for (std::size_t c = 0; c < excess.size(); ++c) {
        excess[c] = s * system.matrix.diag()[c];
        largest = std::max(largest, std::abs(excess[c]));
    }
    for_each_inner(system, box, [&](int, int low, int high, double value) {
        // s (diagonal + all other entries): the sum of the row, since these are -s c
        excess[low] += s * value;
        excess[high] += s * value;
    });
    for (const PatchCoefficient& of : patches) excess[of.cell] += s * of.value;
    box.ranks.max(&largest, 1);
    // Of the largest diagonal of all ranks, so that all judge alike
    reading.noise = rounding * largest;
}

void divide_by_height(const BoxCells& box, Reading& reading) {
    for (std::size_t c = 0; c < reading.excess.size(); ++c)
        reading.excess[c] /= reading.height_of(box.row(box.place[c]));
}

/// The only cell with an excess, if all others have none.
void take_reference(const BoxCells& box, Reading& reading) {
    double with_excess = 0.0, last[] = {-1.0, 0.0};  // place and excess
    std::size_t cell = 0;
    for (std::size_t c = 0; c < reading.excess.size(); ++c) {
        if (!(reading.excess[c] > reading.noise)) continue;
        ++with_excess;
        cell = c;
        last[0] = box.place[c];
        last[1] = reading.excess[c];
    }
    const bool here = with_excess == 1.0;
    box.ranks.sum(&with_excess, 1);
    // A single cell is neither a side nor alpha.
    if (with_excess != 1.0) return;
    box.ranks.max(last, 2);
    reading.reference = static_cast<int>(last[0]);
    reading.stiffening = last[1];
    if (here) reading.excess[cell] = 0.0;
}

/// Corners belong to two sides and are ignored.
void read_sides(const BoxCells& box, Reading& reading) {
    const int nx = box.cells[0], ny = box.cells[1];
    double sums[6] = {};  // four sides, inside, all
    for (std::size_t c = 0; c < reading.excess.size(); ++c) {
        const int i = box.column(box.place[c]), j = box.row(box.place[c]);
        const bool end_x = i == 0 || i == nx - 1, end_y = j == 0 || j == ny - 1;
        sums[5] += reading.excess[c];
        if (end_x && !end_y) sums[i == 0 ? 0 : 1] += reading.excess[c];
        if (end_y && !end_x) sums[j == 0 ? 2 : 3] += reading.excess[c];
        if (!end_x && !end_y) sums[4] += reading.excess[c];
    }
    box.ranks.sum(sums, 6);
    for (int side = 0; side < 4; ++side)
        // Means over the side without its two corners
        reading.at_side[side] = sums[side] / ((side < 2 ? ny : nx) - 2);
    reading.inside = sums[4] / (static_cast<double>(nx - 2) * (ny - 2));
    reading.everywhere = sums[5] / (static_cast<double>(nx) * ny);
}

/// `rows_differ`: rows may have different heights; otherwise the mean coefficients are read.
Reading read(const SolverMatrix& system, const BoxCells& box, bool rows_differ) {
    Reading reading;
    const std::vector<PatchCoefficient> patches = patch_coefficients(system, box);
    // Each step needs those before it: the sign, then heights, then the excess, of which a
    // reference must be taken out before it is divided and sorted by sides.
    read_means(system, box, patches, reading);
    if (rows_differ) read_heights(system, box, patches, reading);
    read_excess(system, box, patches, reading);
    take_reference(box, reading);
    divide_by_height(box, reading);
    read_sides(box, reading);
    return reading;
}

End end_of(const Reading& reading, double alpha, int axis, bool high) {
    if (reading.cyclic[axis]) return End::periodic;
    const double share = reading.at_side[2 * axis + high] - alpha;
    // 2 c or nothing; of a side with both conditions what is nearer (nearest_operator).
    return share > 0.5 * reading.held(2 * axis + high) ? End::dirichlet : End::neumann;
}

BoxOperator operator_of(const Reading& reading, const BoxCells& box) {
    // What is left inside, where no side adds to it; only 0 lets constants be in the kernel.
    const double alpha = std::abs(reading.inside) <= reading.noise ? 0.0 : reading.inside;
    const auto end = [&](int axis, bool high) { return end_of(reading, alpha, axis, high); };
    BoxOperator found;
    found.sign = reading.sign;
    found.plane.x = {box.cells[0], 1.0, end(0, false), end(0, true)};
    // c = beta/h2: with beta = c_x and h = 1 along x, h2 = c_x/c_y along y.
    found.plane.y = {box.cells[1], std::sqrt(reading.mean[0] / reading.mean[1]), end(1, false),
                     end(1, true)};
    for (const double height : reading.height)
        found.plane.y.sizes.push_back(height * found.plane.y.spacing);
    found.problem = {alpha, reading.mean[0]};
    found.reference = reading.reference;
    found.stiffening = reading.stiffening;
    return found;
}

void check_coefficients(const SolverMatrix& system, const BoxCells& box, const Reading& reading) {
    std::string fault;
    const auto check_one = [&](int axis, int cell, int row, double value) {
        // g_j c_x along x, 2 c_y/(g_j + g_{j+1}) along y
        const double magnitude = reading.height.empty() ? reading.mean[axis]
                                 : axis == 0            ? reading.mean[0] * reading.height_of(row)
                                                        : reading.between_rows(row);
        const double expected = -reading.sign * magnitude;
        if (std::abs(value - expected) <= coefficient_tolerance * magnitude) return;
        if (!fault.empty()) return;
        fault = std::string("the coefficients along ") + axis_names[axis] +
                (reading.height.empty() ? " are not all equal: " : " do not fit rows of cells: ") +
                number(value) + " at " + cell_name(box, cell) + ", " + number(expected) +
                (reading.height.empty() ? " on average" : " expected");
    };
    const auto lower_row = [&](int a, int b) { return std::min(box.row(a), box.row(b)); };
    for_each_inner(system, box, [&](int axis, int low, int high, double value) {
        check_one(axis, low, lower_row(box.place[low], box.place[high]), value);
    });
    for (const PatchCoefficient& of : patch_coefficients(system, box))
        check_one(of.axis, of.cell, lower_row(box.place[of.cell], of.beyond), of.value);
    demand(box.ranks, fault);
}

/// alpha + 2 c for each side at this place that holds a value.
double expected_excess(const BoxOperator& found, const Reading& reading, int i, int j) {
    const AxisOperator& x = found.plane.x;
    const AxisOperator& y = found.plane.y;
    const auto holds = [](const AxisOperator& axis, int at) {
        return (at == 0 && axis.lower == End::dirichlet) +
               (at == axis.cells - 1 && axis.upper == End::dirichlet);
    };
    // Only at the ends: `holds` is zero within.
    const double across = reading.held(j == 0 ? 2 : 3);
    return found.problem.alpha + reading.held(0) * holds(x, i) + across * holds(y, j);
}

std::string misfit(const BoxOperator& found, const Reading& reading, const BoxCells& box, int cell,
                   double expected) {
    return "the diagonal at " + cell_name(box, cell) + " exceeds its neighbours by " +
           number(reading.excess[cell]) + " where " + number(expected) +
           " would fit a side with a single condition (" + number(found.problem.alpha) +
           " inside, plus " + number(reading.held(0)) + " or " + number(reading.held(2)) +
           " for a value held at a side)";
}

void check_diagonal(const BoxOperator& found, const Reading& reading, const BoxCells& box) {
    if (found.problem.alpha < 0.0)
        throw DoesNotFit(
            "its diagonal is smaller than the sum of its neighbours' coefficients, by " +
            number(-found.problem.alpha));
    std::string fault;
    for (std::size_t c = 0; c < reading.excess.size() && fault.empty(); ++c) {
        const double expected =
            expected_excess(found, reading, box.column(box.place[c]), box.row(box.place[c]));
        const double off = std::abs(reading.excess[c] - expected);
        // Also where two conditions meet on one side: `at_side` is a mean.
        if (off > coefficient_tolerance * expected + reading.noise)
            fault = misfit(found, reading, box, static_cast<int>(c), expected);
    }
    demand(box.ranks, fault);
}

}  // namespace

BoxOperator exact_operator(const SolverMatrix& system, const BoxCells& box) {
    const Reading reading = read(system, box, true);
    check_coefficients(system, box, reading);
    const BoxOperator found = operator_of(reading, box);
    check_diagonal(found, reading, box);
    return found;
}

BoxOperator nearest_operator(const SolverMatrix& system, const BoxCells& box) {
    const Reading reading = read(system, box, false);
    BoxOperator found = operator_of(reading, box);
    found.problem.alpha = std::max(found.problem.alpha, 0.0);
    // A few faces may hold a value although their side as a whole does not. Then constants are not
    // in the kernel of A, and must not be in that of this operator: 1.A1 is preserved instead.
    if (found.floating() && found.reference < 0 && reading.everywhere > reading.noise)
        found.problem.alpha = reading.everywhere;
    return found;
}

}  // namespace turbidite
