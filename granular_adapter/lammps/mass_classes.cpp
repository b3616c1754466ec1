// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/mass_classes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace turbidite::lammps {
namespace {

using Masses = std::set<double>;

/// The different masses; of more than `most` only the smallest ones and the largest.
Masses few(Masses all) {
    // One more than there are types is enough to know that there are too many; the classes then
    // need the extremes only.
    while (all.size() > MassClasses::most + 1) all.erase(std::prev(all.end(), 2));
    return all;
}

Masses of_all_ranks(const Masses& mine, MPI_Comm communicator) {
    constexpr int room = int(MassClasses::most) + 1;
    int ranks = 1;
    MPI_Comm_size(communicator, &ranks);
    // Zero fills the places that are left.
    std::vector<double> own(room, 0.0), all(std::size_t(room * ranks));
    std::copy(mine.begin(), mine.end(), own.begin());
    MPI_Allgather(own.data(), room, MPI_DOUBLE, all.data(), room, MPI_DOUBLE, communicator);
    Masses result(all.begin(), all.end());
    result.erase(0.0);
    return result;
}

std::vector<double> middles(double lightest, double heaviest, std::size_t count) {
    // m_i = m_min exp((i + 1/2) w),   w = ln(m_max/m_min)/K
    const double width = std::log(heaviest / lightest) / double(count);
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(lightest * std::exp((double(i) + 0.5) * width));
    return result;
}

}  // namespace

MassClasses::MassClasses(const std::vector<double>& masses, MPI_Comm communicator) {
    const Masses all = of_all_ranks(few(Masses(masses.begin(), masses.end())), communicator);
    if (all.empty())
        masses_ = {1.0};
    else if (all.size() <= most)
        masses_.assign(all.begin(), all.end());
    else
        masses_ = middles(*all.begin(), *all.rbegin(), most);
}

int MassClasses::type_of(double mass) const {
    const auto nearer = [mass](double a, double b) {
        return std::abs(std::log(mass / a)) < std::abs(std::log(mass / b));
    };
    return 1 + int(std::min_element(masses_.begin(), masses_.end(), nearer) - masses_.begin());
}

}  // namespace turbidite::lammps
