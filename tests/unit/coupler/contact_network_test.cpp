// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/contact_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace turbidite {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double step = 0.01;

/// Two grains at distance 1 in the direction `angle`, pushing each other with `force` along it.
ContactRecord push(GrainId a, GrainId b, double angle, double force = 1.0) {
    ContactRecord contact;
    contact.a = a;
    contact.b = b;
    contact.normal = {std::cos(angle), std::sin(angle), 0.0};
    contact.branch = contact.normal;
    for (int axis = 0; axis < 2; ++axis)
        contact.impulse[axis] = step * force * contact.normal[axis];
    return contact;
}

ContactRecord on_floor(GrainId grain, double force = 1.0) {
    ContactRecord contact = push(0, grain, pi / 2, force);
    contact.wall = 2;
    contact.branch = {0.0, 0.5, 0.0};
    return contact;
}

/// Links of an n x n lattice with unit forces: to the right, and upwards in the directions
/// `angles`, where the neighbour in the row above is `shift` columns further.
std::vector<ContactRecord> lattice(int n, bool triangular) {
    std::vector<ContactRecord> contacts;
    for (int row = 0; row < n; ++row)
        for (int k = 0; k < n; ++k) {
            const GrainId id = row * n + k;
            if (k + 1 < n) contacts.push_back(push(id, id + 1, 0.0));
            if (row + 1 == n) continue;
            contacts.push_back(push(id, id + n, triangular ? pi / 3 : pi / 2));
            if (triangular && k > 0) contacts.push_back(push(id, id + n - 1, 2 * pi / 3));
        }
    std::sort(contacts.begin(), contacts.end(), contact_before);
    return contacts;
}

TEST(ContactNetwork, OfASquareLattice) {
    const ContactNetwork network = contact_network(lattice(10, false), 100, step);
    EXPECT_EQ(network.grain_links, 180);
    EXPECT_DOUBLE_EQ(*network.coordination, 3.6);  // 4 (n - 1)/n
    EXPECT_EQ(network.loose_grains, 0);
    EXPECT_NEAR(network.fabric->anisotropy, 0.0, 1e-14);
    EXPECT_NEAR(*network.normal_force, 1.0, 1e-14);
    EXPECT_NEAR(network.virial.xx, 90.0, 1e-11);
    EXPECT_NEAR(network.virial.yy, 90.0, 1e-11);
    EXPECT_NEAR(network.virial.xy, 0.0, 1e-11);
}

// 90 links along the rows, and 90 and 81 at 60 and 120 degrees: the sums of cos 2 theta and sin 2
// theta.
TEST(ContactNetwork, OfATriangularLattice) {
    const ContactNetwork network = contact_network(lattice(10, true), 100, step);
    EXPECT_EQ(network.grain_links, 261);
    const double cosine = 90 - 0.5 * (90 + 81), sine = std::sqrt(0.75) * (90 - 81);
    EXPECT_NEAR(network.fabric->anisotropy, 2 * std::hypot(cosine, sine) / 261, 1e-14);
    EXPECT_NEAR(network.fabric->angle, 0.5 * std::atan2(sine, cosine), 1e-14);
    // Equal forces in three directions at 60 degrees: isotropic stress, apart from the 9 missing
    // links.
    EXPECT_NEAR(network.virial.xx, 90 + 0.25 * 171, 1e-11);
    EXPECT_NEAR(network.virial.yy, 0.75 * 171, 1e-11);
}

TEST(ContactNetwork, KnowsOneDirectionWhicheverEndANormalHas) {
    const double angle = 0.3;
    const auto network =
        contact_network({push(1, 2, angle), push(3, 4, angle + pi), push(5, 6, angle)}, 6, step);
    EXPECT_NEAR(network.fabric->anisotropy, 2.0, 1e-14);
    EXPECT_NEAR(network.fabric->angle, angle, 1e-14);
}

// A tower of n discs of weight w, D = 1: the stress at a height is the weight above it, and its sum
// over the links is the sum of each weight times its height.
TEST(ContactNetwork, StressOfATowerIsItsWeightTimesHeight) {
    const double weight = 0.7;
    const int n = 5;
    std::vector<ContactRecord> contacts;
    for (int k = 1; k < n; ++k) contacts.push_back(push(k, k + 1, pi / 2, weight * (n - k)));
    contacts.push_back(on_floor(1, weight * n));
    double expected = 0.0;
    for (int k = 0; k < n; ++k) expected += weight * (k + 0.5);
    const ContactNetwork network = contact_network(contacts, n, step);
    EXPECT_NEAR(network.virial.yy, expected, 1e-12);
    EXPECT_NEAR(network.virial.xx, 0.0, 1e-12);
    EXPECT_DOUBLE_EQ(*network.coordination, (2.0 * (n - 1) + 1.0) / n);
    EXPECT_NEAR(*network.normal_force, weight * (4 + 3 + 2 + 1) / 4, 1e-12);
}

// Shear: different forces at +45 and -45 degrees; the tensor stays symmetric.
// Programs that fill in impulses alone: zero would be taken for a stress.
TEST(ContactNetwork, HasNoStressWithoutBranches) {
    std::vector<ContactRecord> contacts = {push(1, 2, 0.0), on_floor(2)};
    std::sort(contacts.begin(), contacts.end(), contact_before);
    EXPECT_TRUE(contact_network(contacts, 2, step).has_branches);
    contacts[1].branch = {};
    EXPECT_FALSE(contact_network(contacts, 2, step).has_branches);
}

TEST(ContactNetwork, ReportsShear) {
    const auto network =
        contact_network({push(1, 2, pi / 4, 3.0), push(3, 4, -pi / 4, 1.0)}, 4, step);
    EXPECT_NEAR(network.virial.xx, 2.0, 1e-12);
    EXPECT_NEAR(network.virial.yy, 2.0, 1e-12);
    EXPECT_NEAR(network.virial.xy, 1.0, 1e-12);
}

// Two triangles face to face have one neighbour each, and the sum of the forces of both points.
TEST(ContactNetwork, PointsOfAPairAreOneLink) {
    std::vector<ContactRecord> contacts = {push(1, 2, 0.0, 1.0), push(1, 2, 0.0, 2.0)};
    contacts[1].feature = 1;
    contacts[1].status = ContactStatus::sliding;
    const ContactNetwork network = contact_network(contacts, 2, step);
    EXPECT_EQ(network.grain_links, 1);
    EXPECT_DOUBLE_EQ(*network.coordination, 1.0);
    EXPECT_NEAR(*network.normal_force, 3.0, 1e-13);
    EXPECT_NEAR(network.virial.xx, 3.0, 1e-13);
    EXPECT_DOUBLE_EQ(*network.sliding_share, 0.5);
}

// A grain at two walls; and grain 1, which touches no wall although the `a` of a wall contact may
// be any number.
TEST(ContactNetwork, WallsCountOnceAndGrainsWithoutContactsDoNotCount) {
    ContactRecord left = on_floor(7);
    left.wall = 0;
    const ContactNetwork network = contact_network({left, on_floor(7)}, 4, step);
    EXPECT_EQ(network.wall_links, 2);
    EXPECT_EQ(network.loose_grains, 3);
    EXPECT_DOUBLE_EQ(*network.coordination, 2.0);
    EXPECT_FALSE(network.fabric) << "of walls only";
    EXPECT_FALSE(network.normal_force);
}

// What is held apart by a film transmits a force, but does not touch.
TEST(ContactNetwork, FilmsAreNoContacts) {
    std::vector<ContactRecord> contacts = {push(1, 2, 0.0, 1.0), push(2, 3, 0.0, 2.0)};
    contacts[0].status = ContactStatus::sliding;
    contacts[1].status = ContactStatus::film;
    const ContactNetwork network = contact_network(contacts, 3, step);
    EXPECT_EQ(network.grain_links, 1);
    EXPECT_EQ(network.loose_grains, 1);
    EXPECT_DOUBLE_EQ(*network.sliding_share, 1.0);
    EXPECT_NEAR(*network.normal_force, 1.0, 1e-13);
    EXPECT_NEAR(network.virial.xx, 3.0, 1e-13);
}

TEST(ContactNetwork, WithoutContactsHasNoMeans) {
    const ContactNetwork network = contact_network({}, 3, step);
    EXPECT_EQ(network.loose_grains, 3);
    EXPECT_FALSE(network.coordination);
    EXPECT_FALSE(network.fabric);
    EXPECT_FALSE(network.sliding_share);
    EXPECT_EQ(network.virial.yy, 0.0);
}

}  // namespace
}  // namespace turbidite
