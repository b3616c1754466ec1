// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/discs.hpp"

#include <fmt/format.h>
#include <lammps/library.h>

#include <algorithm>
#include <cmath>

#include "coupler/rigid/rotation.hpp"

namespace turbidite::lammps {

/// A body on its way to the rank that will own it.
struct Discs::Newcomer {
    GrainId id;
    int type;
    double mass, radius, turn_factor;
    Vec3 position, velocity;
    double spin, angle;
};

std::string Discs::declaration() {
    return fmt::format("fix own all property/atom i_from_rank i_from_place d2_own {} ghost yes",
                       int(own_columns));
}

Discs::Newcomer Discs::newcomer(const nscd::Bodies& bodies, std::size_t i,
                                const MassClasses& classes) {
    const double mass = bodies.mass[i], radius = bodies.radius[i];
    return {bodies.id[i],
            classes.type_of(mass),
            mass,
            radius,
            0.5 * mass * radius * radius / bodies.inertia[i].zz,
            bodies.position[i],
            bodies.twist[i].velocity,
            bodies.twist[i].spin[2],
            angle_about_z(bodies.orientation[i])};
}

/// Each rank in turn shows its bodies to all, which take those in their subdomains: no rank holds
/// more than one share of another.
void Discs::create(const nscd::Bodies& bodies, const MassClasses& classes, MPI_Comm communicator) {
    int rank = 0, ranks = 1;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &ranks);
    for (int giver = 0, known = 0; giver < ranks; ++giver) {
        std::vector<Newcomer> shown;
        if (giver == rank)
            for (std::size_t i = 0; i < bodies.size(); ++i)
                shown.push_back(newcomer(bodies, i, classes));
        int count = int(shown.size());
        MPI_Bcast(&count, 1, MPI_INT, giver, communicator);
        shown.resize(std::size_t(count));
        MPI_Bcast(shown.data(), int(shown.size() * sizeof(Newcomer)), MPI_BYTE, giver,
                  communicator);
        take(shown, giver, known + 1);
        known += count;
    }
}

/// LAMMPS keeps those in its subdomain, after those it has, and knows them by the numbers it gets.
void Discs::take(const std::vector<Newcomer>& newcomers, int giver, int first_tag) {
    std::vector<int> tags, types;
    std::vector<double> places, velocities;
    for (const Newcomer& disc : newcomers) {
        tags.push_back(first_tag + int(tags.size()));
        types.push_back(disc.type);
        places.insert(places.end(), disc.position.begin(), disc.position.end());
        velocities.insert(velocities.end(), disc.velocity.begin(), disc.velocity.end());
    }
    const int before = lammps_.local_count();
    lammps_create_atoms(lammps_.handle(), int(tags.size()), tags.data(), types.data(),
                        places.data(), velocities.data(), nullptr, 1);
    const int* tag = lammps_.atoms<int*>("id");
    for (int i = before; i < lammps_.local_count(); ++i) {
        const auto k = static_cast<std::size_t>(tag[i] - first_tag);
        const Newcomer& disc = newcomers[k];
        double* own = lammps_.atoms<double**>("d2_own")[i];
        lammps_.atoms<double*>("rmass")[i] = disc.mass;
        lammps_.atoms<double*>("radius")[i] = disc.radius;
        lammps_.atoms<double**>("omega")[i][2] = disc.spin;
        own[turn_factor] = disc.turn_factor;
        own[angle] = disc.angle;
        own[id_high] = double(disc.id >> 32);
        own[id_low] = double(disc.id & 0xFFFFFFFF);
        lammps_.atoms<int*>("i_from_rank")[i] = giver;
        lammps_.atoms<int*>("i_from_place")[i] = int(k);
    }
}

void Discs::read(nscd::Bodies& bodies) const {
    double** x = lammps_.atoms<double**>("x");
    double** v = lammps_.atoms<double**>("v");
    double** omega = lammps_.atoms<double**>("omega");
    double** own = lammps_.atoms<double**>("d2_own");
    for_each([&](std::size_t place, int i) {
        bodies.position[place] = {x[i][0], x[i][1], 0.0};
        bodies.orientation[place] = about_z(own[i][angle]);
        bodies.twist[place] = {{v[i][0], v[i][1], 0.0}, {0.0, 0.0, omega[i][2]}};
    });
}

void Discs::write(const nscd::Bodies& bodies) {
    double** x = lammps_.atoms<double**>("x");
    double** v = lammps_.atoms<double**>("v");
    double** omega = lammps_.atoms<double**>("omega");
    double** own = lammps_.atoms<double**>("d2_own");
    for_each([&](std::size_t place, int i) {
        std::copy_n(bodies.position[place].begin(), 2, x[i]);
        std::copy_n(bodies.twist[place].velocity.begin(), 2, v[i]);
        omega[i][2] = bodies.twist[place].spin[2];
        own[i][angle] = angle_about_z(bodies.orientation[place]);
    });
}

std::vector<Origin> Discs::origins() const {
    const int* rank = lammps_.atoms<int*>("i_from_rank");
    std::vector<Origin> result;
    for_each([&](std::size_t place, int i) { result.push_back({rank[i], int(place)}); });
    return result;
}

void Discs::number(const std::vector<Origin>& order, int rank) {
    int* from_rank = lammps_.atoms<int*>("i_from_rank");
    int* from_place = lammps_.atoms<int*>("i_from_place");
    std::vector<std::pair<Origin, int>> by_origin;
    for (std::size_t k = 0; k < order.size(); ++k) by_origin.push_back({order[k], int(k)});
    const auto before = [](const auto& a, const auto& b) {
        return std::tie(a.first.rank, a.first.place) < std::tie(b.first.rank, b.first.place);
    };
    std::sort(by_origin.begin(), by_origin.end(), before);
    for (int i = 0; i < lammps_.local_count(); ++i) {
        const std::pair<Origin, int> wanted{{from_rank[i], from_place[i]}, 0};
        const auto found = std::lower_bound(by_origin.begin(), by_origin.end(), wanted, before);
        from_rank[i] = rank;
        from_place[i] = found->second;
    }
}

GrainId Discs::id(int index) const {
    const double* own = lammps_.atoms<double**>("d2_own")[index];
    return (GrainId(own[id_high]) << 32) | GrainId(own[id_low]);
}

void Discs::remove(const std::vector<std::int64_t>& tags) {
    for (const std::int64_t tag : tags) lammps_.command(fmt::format("group gone id {}", tag));
    lammps_.command("delete_atoms group gone compress no");
    lammps_.command("group gone clear");
}

}  // namespace turbidite::lammps
