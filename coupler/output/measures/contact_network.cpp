// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/contact_network.hpp"

#include <cmath>
#include <unordered_set>

#include "coupler/rigid/vec3.hpp"

namespace turbidite {
namespace {

bool same_pair(const ContactRecord& x, const ContactRecord& y) {
    // Whatever the point (feature). At a wall a means nothing.
    return x.b == y.b && x.wall == y.wall && (x.wall >= 0 || x.a == y.a);
}

/// A film of liquid: it transmits a force, but the surfaces do not touch.
bool is_film(const ContactRecord& contact) {
    return (contact.status & ContactStatus::film) != 0;
}

/// Sums over the links.
class Sums {
 public:
    Sums(double step, int dimension) : step_(step), dimension_(dimension) {}

    void add_point(const ContactRecord& contact) {
        const Vec3& p = contact.impulse;
        const Vec3& l = contact.branch;
        network_.has_branches = network_.has_branches && l != Vec3{};
        network_.virial.xx += p[0] * l[0] / step_;  // f l^T, f = p/dt
        network_.virial.yy += p[1] * l[1] / step_;
        network_.virial.xy += 0.5 * (p[0] * l[1] + p[1] * l[0]) / step_;
        network_.virial.zz += p[2] * l[2] / step_;
        network_.virial.xz += 0.5 * (p[0] * l[2] + p[2] * l[0]) / step_;
        network_.virial.yz += 0.5 * (p[1] * l[2] + p[2] * l[1]) / step_;
        // A film transmits a force, so it is part of the stress. It counts neither as a sliding
        // point nor in the mean normal force.
        if (is_film(contact)) return;
        ++points_;
        sliding_ += (contact.status & ContactStatus::sliding) != 0 ? 1 : 0;
        if (contact.wall < 0) force_ += dot(p, contact.normal) / step_;
    }

    void add_link(const ContactRecord& contact) {
        // Of grains with a link: those without one are counted apart.
        touched_.insert(contact.b);
        if (contact.wall >= 0) {
            ++network_.wall_links;
            return;
        }
        touched_.insert(contact.a);
        ++network_.grain_links;
        const Vec3& n = contact.normal;
        cos2_ += n[0] * n[0] - n[1] * n[1];  // cos 2 theta
        sin2_ += 2.0 * n[0] * n[1];          // sin 2 theta
        fabric_.xx += n[0] * n[0], fabric_.yy += n[1] * n[1], fabric_.zz += n[2] * n[2];
        fabric_.xy += n[0] * n[1], fabric_.xz += n[0] * n[2], fabric_.yz += n[1] * n[2];
    }

    ContactNetwork finished(std::size_t grains) {
        const double links = static_cast<double>(network_.grain_links);
        network_.loose_grains = static_cast<std::int64_t>(grains - touched_.size());
        if (!touched_.empty())
            network_.coordination = (2.0 * links + static_cast<double>(network_.wall_links)) /
                                    static_cast<double>(touched_.size());
        if (points_ > 0)
            network_.sliding_share = static_cast<double>(sliding_) / static_cast<double>(points_);
        if (network_.grain_links == 0) return network_;
        network_.fabric = dimension_ == 3 ? fabric_in_space(links) : fabric_in_plane(links);
        network_.normal_force = force_ / links;
        return network_;
    }

 private:
    /// a = 2 (F_1 - F_2) with F_1 - F_2 = |(mean cos 2 theta, mean sin 2 theta)|
    Fabric fabric_in_plane(double links) const {
        return {2.0 * std::hypot(cos2_, sin2_) / links, 0.5 * std::atan2(sin2_, cos2_)};
    }

    /// a = sqrt(3/2) (15/2) |dev F|
    Fabric fabric_in_space(double links) const {
        const Symmetric3 f = 1.0 / links * fabric_;
        const double mean = (f.xx + f.yy + f.zz) / 3.0;
        const double x = f.xx - mean, y = f.yy - mean, z = f.zz - mean;
        const double square =
            x * x + y * y + z * z + 2.0 * (f.xy * f.xy + f.xz * f.xz + f.yz * f.yz);
        return {7.5 * std::sqrt(1.5 * square), 0.0};
    }

    double step_;
    int dimension_;
    ContactNetwork network_;
    Symmetric3 fabric_;  ///< sum of n n^T
    std::unordered_set<GrainId> touched_;
    std::int64_t points_ = 0, sliding_ = 0;
    double force_ = 0.0, cos2_ = 0.0, sin2_ = 0.0;
};

}  // namespace

ContactNetwork contact_network(const std::vector<ContactRecord>& contacts, std::size_t grains,
                               double step, int dimension) {
    Sums sums(step, dimension);
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        sums.add_point(contacts[k]);
        // No link: the surfaces do not touch.
        if (is_film(contacts[k])) continue;
        if (k == 0 || !same_pair(contacts[k - 1], contacts[k])) sums.add_link(contacts[k]);
    }
    return sums.finished(grains);
}

}  // namespace turbidite
