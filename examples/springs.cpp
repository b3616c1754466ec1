// SPDX-License-Identifier: LGPL-2.1-or-later
//
// springs RUN: discs or spheres with springs and dashpots, in sub-steps, as a grains adapter.
// Frictionless; the same model as springs.py. docs/write-an-adapter.md explains every line.
#include <turbidite/coupler/participant/participant.hpp>
#include <turbidite/coupler/protocol/run_values.hpp>
#include <turbidite/coupler/protocol/wire.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

using namespace turbidite;

class Springs : public GrainsAdapter {
    struct Grain {
        double mass, weight;  // cM and (M - m_f) g of step 4
        Vec3 x, v, impulse;
    };
    RunValues run;
    double omega = 0, damping = 0, deepest = 0;
    std::int64_t substeps = 1;
    Motion state;
    std::vector<Grain> moving;

    Hello describe() const override {
        Hello hello;
        hello.adapter = "springs";
        hello.host_code = "C++";
        hello.capabilities.native_substeps = true;
        hello.capabilities.saves_state = true;
        hello.dimension = both_dimensions;
        hello.capabilities.shapes = {"disc", "sphere"};
        return hello;
    }

    // Cases with friction, free sides, ... are refused.
    std::optional<Abilities> abilities() const override {
        Abilities able;
        able.restitution = true;  // run.md_damping is made for it
        return able;
    }

    Motion initialise(const Settings& s, const ShapeTable&,
                      const std::vector<GrainState>& grains) override {
        run = run_values(s);
        omega = s.real("run.md_frequency"), damping = s.real("run.md_damping");
        substeps = s.integer("run.md_substeps");
        state.grains = grains;
        for (const GrainState& g : grains) {
            // The liquid may see a grain smaller or larger than it is.
            const double seen = run.hydrodynamic_radius * g.radius + run.surface_shift;
            moving.push_back({volume(g.radius) * g.density - volume(seen) * run.fluid_density,
                              volume(g.radius) * (g.density - run.fluid_density) * run.gravity,
                              {},
                              {},
                              {}});
        }
        return state;
    }

    double volume(double radius) const {  // of a disc per unit length
        const double disc = M_PI * radius * radius;
        return run.dimension == 3 ? 4.0 / 3.0 * radius * disc : disc;
    }

    // Spring and dashpot: no attraction.
    double force(double overlap, double closing, double reduced_mass) {
        deepest = std::max(deepest, overlap);
        if (overlap <= 0) return 0;
        return std::max(0.0, reduced_mass * omega * (omega * overlap + 2 * damping * closing));
    }

    void touch(Grain& a, Grain& b, double radii, double dt) {  // b may be anywhere
        const double d = norm(b.x - a.x);
        if (d > radii) return;
        const Vec3 n = (b.x - a.x) / d;
        const double closing = dot(a.v - b.v, n);
        const double f = force(radii - d, closing, a.mass * b.mass / (a.mass + b.mass));
        a.impulse = a.impulse - dt * f * n, b.impulse = b.impulse + dt * f * n;
    }

    void substep(double dt) {
        const std::vector<Grain> before = moving;
        for (std::size_t i = 0; i < moving.size(); ++i) {
            for (std::size_t j = i + 1; j < moving.size(); ++j)  // all pairs: an example
                touch(moving[i], moving[j], state.grains[i].radius + state.grains[j].radius, dt);
            Grain& d = moving[i];
            const double r = state.grains[i].radius;
            for (int k = 0; k < run.dimension; ++k) {
                d.impulse[k] += dt * force(r - d.x[k], -d.v[k], d.mass);
                d.impulse[k] -= dt * force(r - (run.size[k] - d.x[k]), d.v[k], d.mass);
            }
        }
        for (std::size_t i = 0; i < moving.size(); ++i) {
            Grain& d = moving[i];
            for (int k = 0; k < run.dimension; ++k) {
                const double weight = k == 1 ? dt * d.weight : 0.0;
                d.v[k] += (d.impulse[k] - before[i].impulse[k] - weight) / d.mass;
                d.x[k] += dt * d.v[k];
            }
        }
    }

    // Step 4: configurations of the start of the window, velocities after the contacts, impulses.
    Motion advance(const Window& window, const std::vector<FreeResponse>&) override {
        deepest = 0;
        for (std::size_t i = 0; i < moving.size(); ++i)
            moving[i].x = state.grains[i].position, moving[i].v = state.grains[i].velocity,
            moving[i].impulse = {};
        for (int k = 0; k < substeps; ++k) substep(window.step / substeps);
        state.report = {};
        state.report.iterations = substeps;
        for (std::size_t i = 0; i < moving.size(); ++i) {
            state.grains[i].velocity = moving[i].v;
            state.grains[i].contact_impulse = moving[i].impulse;
            state.report.contacts += moving[i].impulse != Vec3{};
        }
        return state;
    }

    // By a vector, of angle |turn| about its direction: the product of two quaternions (w, x, y,
    // z).
    static Quaternion turned(const Quaternion& q, const Vec3& turn) {
        const double angle = norm(turn), c = std::cos(angle / 2);
        const Vec3 s = (angle > 0 ? std::sin(angle / 2) / angle : 0.5) * turn;
        const Vec3 v{q[1], q[2], q[3]};
        const Vec3 r = c * v + q[0] * s + cross(s, v);
        return {c * q[0] - dot(s, v), r[0], r[1], r[2]};
    }

    // Corrected velocities; grains without a contact move with them over the whole window.
    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        std::unordered_map<GrainId, const Kick*> by_id;
        for (const Kick& kick : kicks) by_id[kick.id] = &kick;
        for (std::size_t i = 0; i < moving.size(); ++i) {
            GrainState& g = state.grains[i];
            if (!kicks.empty())  // none without a fluid
                g.velocity = by_id.at(g.id)->velocity,
                g.angular_velocity = by_id.at(g.id)->angular_velocity;
            g.orientation = turned(g.orientation, window.step * g.angular_velocity);
            const bool touched = moving[i].impulse != Vec3{};
            for (int k = 0; k < run.dimension; ++k)
                g.position[k] =
                    touched ? moving[i].x[k] : g.position[k] + window.step * g.velocity[k];
        }
        state.report.max_penetration = deepest;
        return state;
    }

    // All that a window passes to the next one.
    SavedState save() const override { return encode(state); }
    void restore(const SavedState& saved) override { state = decode<Motion>(saved); }
};

int main(int argc, char** argv) {
    Springs springs;
    return run_grains(springs, {&argc, &argv, argv[argc - 1]});
}
