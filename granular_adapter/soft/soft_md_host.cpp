// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/soft/soft_md_host.hpp"

#include <algorithm>

#include "coupler/protocol/run_values.hpp"
#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/grains/borders.hpp"
#include "granular_adapter/nscd/engine/theta_scheme.hpp"
#include "granular_adapter/nscd/problem/byte_stream.hpp"

namespace turbidite::soft {
namespace {

// Grains up to this distance are neighbours, over the smallest radius.
constexpr double neighbour_margin = 0.2;

double skin_of(const nscd::Bodies& bodies) {
    if (bodies.size() == 0) return 0.0;
    return neighbour_margin * *std::min_element(bodies.radius.begin(), bodies.radius.end());
}

/// `force` at the end of an arm from the centre.
void push(Load& total, const Vec3& force, const Vec3& arm) {
    total.force = total.force + force;
    total.torque = total.torque + cross(arm, force);
}

}  // namespace

std::vector<std::string> SoftMdHost::shapes() const {
    std::vector<std::string> names;
    for (const auto& entry : nscd::wall_detector_list()) names.push_back(entry.kind);
    return names;
}

void SoftMdHost::create(const Settings& settings, const ShapeTable& shapes,
                        const nscd::Bodies& bodies) {
    law_.emplace(settings);
    const RunValues run = run_values(settings);
    gravity_ = run.gravity;
    box_.length = run.period;
    const std::vector<nscd::Wall> walls = walls_of(lay_borders(settings));
    sides_.clear();
    for (const nscd::Wall& wall : walls) sides_.push_back(wall.key);
    finder_.emplace(shapes, walls, box_, skin_of(bodies));
    bodies_ = bodies;
}

void SoftMdHost::read(nscd::Bodies& bodies) const {
    bodies.position = bodies_.position;
    bodies.orientation = bodies_.orientation;
    bodies.twist = bodies_.twist;
}

void SoftMdHost::write(const nscd::Bodies& bodies) {
    bodies_.position = bodies.position;
    bodies_.orientation = bodies.orientation;
    bodies_.twist = bodies.twist;
}

// ---- sub-steps -------------------------------------------------------------------------------

SubstepReport SoftMdHost::run(const Substeps& substeps, const std::vector<Load>& loads) {
    SubstepReport report;
    report.impulses.assign(bodies_.size(), Vec3{});
    report.angular_impulses.assign(bodies_.size(), Vec3{});
    for (std::int64_t k = 1; k <= substeps.count; ++k) {
        // Forces, reports and impulses belong to the positions at the start of the sub-step.
        find_forces(loads, substeps.step);
        watch(report);
        add_impulses(report, substeps.step);
        if (substeps.detailed && k == substeps.count)
            report.touching = touching(substeps.step * static_cast<double>(substeps.count));
        move(substeps.step);
    }
    return report;
}

void SoftMdHost::find_forces(const std::vector<Load>& loads, double step) {
    finder_->find(bodies_);
    const std::vector<Overlap>& overlaps = finder_->overlaps();
    // Springs of points that are no longer there are forgotten, new ones begin unstretched.
    slips_.follow(overlaps);
    totals_ = loads;
    forces_.clear();
    for (std::size_t i = 0; i < overlaps.size(); ++i) {
        const nscd::ContactPoint& point = overlaps[i].point;
        forces_.push_back(point_force(*law_, overlaps[i], bodies_, step, slips_[i]));
        push(totals_[point.b], forces_[i].on_b, point.arm_b);
        if (point.wall < 0) push(totals_[point.a], -1.0 * forces_[i].on_b, point.arm_a);
    }
}

void SoftMdHost::move(double step) {
    // The same gravity for all bodies; what the weight of a body in the fluid differs by is in its
    // load.
    const Vec3 fall{0.0, -gravity_, 0.0};
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        Twist& twist = bodies_.twist[i];
        // v <- v + delta (F/m + g)
        twist.velocity =
            twist.velocity + step * (bodies_.inverse_mass(i) * totals_[i].force + fall);
        twist.spin = twist.spin + step * (bodies_.inverse_inertia(i) * totals_[i].torque);
    }
    // Leap-frog: x <- x + delta v with the new velocity.
    nscd::move(bodies_, bodies_.twist, step, box_);
}

void SoftMdHost::watch(SubstepReport& report) const {
    // Overwritten in each sub-step: the contacts of the last one.
    report.contacts = std::count_if(forces_.begin(), forces_.end(),
                                    [](const PointForce& force) { return force.pushes; });
    for (const Overlap& overlap : finder_->overlaps())
        report.max_penetration = std::max(report.max_penetration, -overlap.point.gap);
}

void SoftMdHost::add_impulses(SubstepReport& report, double step) const {
    for (std::size_t i = 0; i < totals_.size(); ++i) {
        report.impulses[i] = report.impulses[i] + step * totals_[i].force;
        report.angular_impulses[i] = report.angular_impulses[i] + step * totals_[i].torque;
    }
}

/// Impulses are the present forces times `window` [s].
std::vector<ContactRecord> SoftMdHost::touching(double window) const {
    std::vector<ContactRecord> records;
    for (std::size_t i = 0; i < forces_.size(); ++i)
        if (forces_[i].pushes)
            records.push_back(record(finder_->overlaps()[i], forces_[i], window));
    std::sort(records.begin(), records.end(), contact_before);
    return records;
}

ContactRecord SoftMdHost::record(const Overlap& overlap, const PointForce& force,
                                 double window) const {
    const nscd::ContactPoint& point = overlap.point;
    ContactRecord record;
    record.b = bodies_.id[point.b];
    if (point.wall >= 0)
        record.wall = sides_[point.wall];
    else
        record.a = bodies_.id[point.a];
    record.feature = point.feature;
    record.status = force.slides ? ContactStatus::sliding : 0;
    record.gap = point.gap;
    record.length = point.length;
    record.point = bodies_.position[point.b] + point.arm_b;
    record.normal = point.normal;
    record.branch = (point.wall >= 0 ? Vec3{} : point.arm_a) - point.arm_b;
    record.impulse = window * force.on_b;
    return record;
}

// ---- bodies that leave, and state ------------------------------------------------------------

/// The springs of those that leave go with the next sub-step.
void SoftMdHost::keep(const std::vector<std::uint8_t>& mask) {
    bodies_.keep(mask);
    finder_->forget();
}

SavedState SoftMdHost::save() const {
    nscd::ByteWriter writer;
    nscd::Bodies::for_each_array(bodies_, [&](const auto& array) { writer.array(array); });
    slips_.save(writer);
    return writer.take();
}

void SoftMdHost::restore(const SavedState& state) {
    nscd::ByteReader reader(state);
    nscd::Bodies::for_each_array(bodies_, [&](auto& array) {
        array = reader.array<typename std::decay_t<decltype(array)>::value_type>();
    });
    slips_.restore(reader);
    finder_->forget();
}

}  // namespace turbidite::soft
