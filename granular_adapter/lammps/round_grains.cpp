// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/round_grains.hpp"

#include <fmt/format.h>
#include <lammps/library.h>

#include <algorithm>
#include <cmath>

#include "coupler/rigid/rotation.hpp"

namespace turbidite::lammps {

/// A body on its way to the rank that will own it.
struct RoundGrains::Newcomer {
    GrainId id;
    int type;
    double mass, radius, turn_factor;
    Vec3 position, velocity, spin;
    Quaternion orientation;
};

std::string RoundGrains::declaration(int dimension) {
    return fmt::format("fix own all property/atom i_from_rank i_from_place d2_own {} ghost yes",
                       int(dimension == 3 ? space_columns : plane_columns));
}

RoundGrains::Newcomer RoundGrains::newcomer(const nscd::Bodies& bodies, std::size_t i,
                                            const MassClasses& classes) const {
    const double mass = bodies.mass[i], radius = bodies.radius[i];
    // c m R^2/I: LAMMPS turns spheres with c = 2/5 and discs with c = 1/2.
    const double share = in_space() ? 0.4 : 0.5;  // of m R^2
    return {bodies.id[i],
            classes.type_of(mass),
            mass,
            radius,
            share * mass * radius * radius / bodies.inertia[i].zz,
            bodies.position[i],
            bodies.twist[i].velocity,
            bodies.twist[i].spin,
            bodies.orientation[i]};
}

/// Each rank in turn shows its bodies to all, which take those in their subdomains: no rank holds
/// more than one share of another.
void RoundGrains::create(const nscd::Bodies& bodies, const MassClasses& classes,
                         MPI_Comm communicator) {
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
void RoundGrains::take(const std::vector<Newcomer>& newcomers, int giver, int first_tag) {
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
        double* omega = lammps_.atoms<double**>("omega")[i];
        freedom().each_turn([&](int axis) { omega[axis] = disc.spin[axis]; });
        own[turn_factor] = disc.turn_factor;
        set_orientation(own, disc.orientation);
        // A double holds 32 bits exactly, but not 64.
        own[id_high] = double(disc.id >> 32);
        own[id_low] = double(disc.id & 0xFFFFFFFF);
        // The row of the grain is still with the giver; migrate() fetches it.
        lammps_.atoms<int*>("i_from_rank")[i] = giver;
        lammps_.atoms<int*>("i_from_place")[i] = int(k);
    }
}

Vec3 RoundGrains::centre(int index) const {
    const double* x = lammps_.atoms<double**>("x")[index];
    return period_.wrap({x[0], x[1], in_space() ? x[2] : 0.0});
}

void RoundGrains::read(nscd::Bodies& bodies) const {
    double** v = lammps_.atoms<double**>("v");
    double** omega = lammps_.atoms<double**>("omega");
    double** own = lammps_.atoms<double**>("d2_own");
    for_each([&](std::size_t place, int i) {
        Twist twist;
        freedom().each_push([&](int axis) { twist.velocity[axis] = v[i][axis]; });
        freedom().each_turn([&](int axis) { twist.spin[axis] = omega[i][axis]; });
        bodies.position[place] = centre(i);
        bodies.orientation[place] = orientation_of(own[i]);
        bodies.twist[place] = twist;
    });
}

void RoundGrains::write(const nscd::Bodies& bodies) {
    double** x = lammps_.atoms<double**>("x");
    double** v = lammps_.atoms<double**>("v");
    double** omega = lammps_.atoms<double**>("omega");
    double** own = lammps_.atoms<double**>("d2_own");
    for_each([&](std::size_t place, int i) {
        const Twist& twist = bodies.twist[place];
        freedom().each_push([&](int axis) {
            x[i][axis] = bodies.position[place][axis], v[i][axis] = twist.velocity[axis];
        });
        freedom().each_turn([&](int axis) { omega[i][axis] = twist.spin[axis]; });
        set_orientation(own[i], bodies.orientation[place]);
    });
}

Quaternion RoundGrains::orientation_of(const double* own) const {
    if (!in_space()) return about_z(own[angle]);
    Quaternion q;
    std::copy_n(own + orientation, 4, q.begin());
    return q;
}

void RoundGrains::set_orientation(double* own, const Quaternion& q) const {
    if (in_space())
        std::copy_n(q.begin(), 4, own + orientation);
    else
        own[angle] = angle_about_z(q);
}

void RoundGrains::turn(double* own, const double* spin, double time) const {
    if (in_space())
        set_orientation(own, rotated(orientation_of(own), time * Vec3{spin[0], spin[1], spin[2]}));
    else
        own[angle] += time * spin[2];
}

std::vector<Origin> RoundGrains::origins() const {
    const int* rank = lammps_.atoms<int*>("i_from_rank");
    std::vector<Origin> result;
    for_each([&](std::size_t place, int i) { result.push_back({rank[i], int(place)}); });
    return result;
}

void RoundGrains::number(const std::vector<Origin>& order, int rank) {
    int* from_rank = lammps_.atoms<int*>("i_from_rank");
    int* from_place = lammps_.atoms<int*>("i_from_place");
    std::vector<std::pair<Origin, int>> by_origin;
    for (std::size_t k = 0; k < order.size(); ++k) by_origin.push_back({order[k], int(k)});
    const auto before = [](const auto& a, const auto& b) {
        return std::tie(a.first.rank, a.first.place) < std::tie(b.first.rank, b.first.place);
    };
    std::sort(by_origin.begin(), by_origin.end(), before);
    for (int i = 0; i < lammps_.local_count(); ++i) {
        // The place in the new order of the grain that came from there.
        const std::pair<Origin, int> wanted{{from_rank[i], from_place[i]}, 0};
        const auto found = std::lower_bound(by_origin.begin(), by_origin.end(), wanted, before);
        from_rank[i] = rank;
        from_place[i] = found->second;
    }
}

GrainId RoundGrains::id(int index) const {
    const double* own = lammps_.atoms<double**>("d2_own")[index];
    return (GrainId(own[id_high]) << 32) | GrainId(own[id_low]);
}

void RoundGrains::remove(const std::vector<std::int64_t>& tags) {
    for (const std::int64_t tag : tags) lammps_.command(fmt::format("group gone id {}", tag));
    lammps_.command("delete_atoms group gone compress no");
    lammps_.command("group gone clear");
}

}  // namespace turbidite::lammps
