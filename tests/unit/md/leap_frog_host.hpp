// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A host of molecular dynamics without YADE: discs on a floor at y = 0 with spring, dashpot and a
// friction force proportional to the slip, and nothing else. A minimal implementation of
// md_host.hpp.
#pragma once

#include <algorithm>

#include "coupler/protocol/run_values.hpp"
#include "granular_adapter/md/md_host.hpp"
#include "granular_adapter/nscd/engine/theta_scheme.hpp"
#include "granular_adapter/nscd/problem/byte_stream.hpp"

namespace turbidite {

class LeapFrogHost final : public MdHost {
 public:
    double stiffness = 1e4, dashpot = 5.0, drag = 3.0;

    std::string code() const override { return "leap-frog"; }
    void create(const Settings& settings, const ShapeTable&, const nscd::Bodies& bodies) override {
        gravity_ = run_values(settings).gravity;
        bodies_ = bodies;
    }
    void read(nscd::Bodies& bodies) const override {
        bodies.position = bodies_.position;
        bodies.orientation = bodies_.orientation;
        bodies.twist = bodies_.twist;
    }
    void write(const nscd::Bodies& bodies) override {
        bodies_.position = bodies.position;
        bodies_.orientation = bodies.orientation;
        bodies_.twist = bodies.twist;
    }

    SubstepReport run(const Substeps& substeps, const std::vector<Load>& loads) override {
        SubstepReport report;
        std::vector<Vec3> impulses(bodies_.size()), moments(bodies_.size());
        for (std::int64_t k = 0; k < substeps.count; ++k)
            for (std::size_t i = 0; i < bodies_.size(); ++i) {
                const Load all = with_floor(i, loads[i], report);
                step(i, all, substeps.step);
                for (int axis = 0; axis < 3; ++axis) {
                    impulses[i][axis] += substeps.step * all.force[axis];
                    moments[i][axis] += substeps.step * all.torque[axis];
                }
            }
        if (substeps.detailed) report.impulses = impulses, report.angular_impulses = moments;
        return report;
    }

    void keep(const std::vector<std::uint8_t>& mask) override { bodies_.keep(mask); }
    SavedState save() const override {
        nscd::ByteWriter writer;
        nscd::Bodies::for_each_array(bodies_, [&](const auto& array) { writer.array(array); });
        return writer.take();
    }
    void restore(const SavedState& state) override {
        nscd::ByteReader reader(state);
        nscd::Bodies::for_each_array(bodies_, [&](auto& array) {
            array = reader.array<typename std::decay_t<decltype(array)>::value_type>();
        });
    }

 private:
    Load with_floor(std::size_t i, Load load, SubstepReport& report) const {
        const double overlap = bodies_.radius[i] - bodies_.position[i][1];
        if (overlap < 0.0) return load;
        report.max_penetration = std::max(report.max_penetration, overlap);
        const Twist& twist = bodies_.twist[i];
        const double push = std::max(0.0, stiffness * overlap - dashpot * twist.velocity[1]);
        const double slip = twist.velocity[0] + bodies_.position[i][1] * twist.spin[2];
        load.force[0] -= drag * slip;
        load.force[1] += push;
        load.torque[2] -= drag * slip * bodies_.position[i][1];
        return load;
    }

    void step(std::size_t i, const Load& load, double delta) {
        Twist& twist = bodies_.twist[i];
        twist.velocity[0] += delta * load.force[0] / bodies_.mass[i];
        twist.velocity[1] += delta * (load.force[1] / bodies_.mass[i] - gravity_);
        twist.spin[2] += delta * load.torque[2] / bodies_.inertia[i].zz;
        for (int axis = 0; axis < 2; ++axis)
            bodies_.position[i][axis] += delta * twist.velocity[axis];
        bodies_.orientation[i] = rotated(bodies_.orientation[i], {0, 0, delta * twist.spin[2]});
    }

    double gravity_ = 0.0;
    nscd::Bodies bodies_;
};

}  // namespace turbidite
