// SPDX-License-Identifier: LGPL-2.1-or-later
//
// springs RUN: discs with springs and dashpots, in sub-steps, as a grains adapter. Frictionless;
// the same model as springs.py. docs/write-an-adapter.md explains every line.
#include <turbidite/coupler/participant/participant.hpp>
#include <turbidite/coupler/protocol/run_values.hpp>
#include <turbidite/coupler/protocol/wire.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

using namespace turbidite;

class Springs : public GrainsAdapter {
    struct Disc {
        double mass, weight;  // cM and (M - m_f) g of step 4
        Vec3 x, v, impulse;
    };
    RunValues run;
    double omega = 0, damping = 0, deepest = 0;
    std::int64_t substeps = 1;
    Motion state;
    std::vector<Disc> discs;

    Hello describe() const override {
        Hello hello;
        hello.adapter = "springs";
        hello.host_code = "C++";
        hello.capabilities.native_substeps = true;
        hello.capabilities.saves_state = true;
        hello.capabilities.shapes = {"disc"};
        return hello;
    }

    Motion initialise(const Settings& s, const ShapeTable&,
                      const std::vector<GrainState>& grains) override {
        for (const char* side : {"left", "right", "bottom", "top"})
            if (s.text(std::string("domain.") + side) != "wall")
                throw std::runtime_error("springs supports four walls only");
        if (s.integer("grains.ranks") > 1)  // contacts with grains of other ranks are not found
            throw std::runtime_error("springs runs on one rank only: grains.ranks");
        if (s.real("contact.friction") > 0)
            throw std::runtime_error("springs knows no friction: contact.friction");
        for (const GrainState& g : grains)
            if (g.prescribed) throw std::runtime_error("springs moves free grains only: motion");
        run = run_values(s);
        omega = s.real("run.md_frequency"), damping = s.real("run.md_damping");
        substeps = s.integer("run.md_substeps");
        state.grains = grains;
        for (const GrainState& g : grains) {
            const double area = M_PI * g.radius * g.radius, h = run.hydrodynamic_radius;
            discs.push_back({area * (g.density - h * h * run.fluid_density),
                             area * (g.density - run.fluid_density) * run.gravity,
                             {},
                             {},
                             {}});
        }
        return state;
    }

    // Spring and dashpot: no attraction.
    double force(double overlap, double closing, double reduced_mass) {
        deepest = std::max(deepest, overlap);
        if (overlap <= 0) return 0;
        return std::max(0.0, reduced_mass * omega * (omega * overlap + 2 * damping * closing));
    }

    void touch(Disc& a, Disc& b, double radii, double dt) {  // b may be anywhere
        const double dx = b.x[0] - a.x[0], dy = b.x[1] - a.x[1], d = std::hypot(dx, dy);
        if (d > radii) return;
        const double n[] = {dx / d, dy / d};
        const double closing = (a.v[0] - b.v[0]) * n[0] + (a.v[1] - b.v[1]) * n[1];
        const double f = force(radii - d, closing, a.mass * b.mass / (a.mass + b.mass));
        for (int k : {0, 1}) a.impulse[k] -= dt * f * n[k], b.impulse[k] += dt * f * n[k];
    }

    void substep(double dt) {
        const std::vector<Disc> before = discs;
        for (std::size_t i = 0; i < discs.size(); ++i) {
            for (std::size_t j = i + 1; j < discs.size(); ++j)  // all pairs: an example
                touch(discs[i], discs[j], state.grains[i].radius + state.grains[j].radius, dt);
            Disc& d = discs[i];
            const double r = state.grains[i].radius;
            for (int k : {0, 1}) {
                d.impulse[k] += dt * force(r - d.x[k], -d.v[k], d.mass);
                d.impulse[k] -= dt * force(r - (run.size[k] - d.x[k]), d.v[k], d.mass);
            }
        }
        for (std::size_t i = 0; i < discs.size(); ++i) {
            Disc& d = discs[i];
            for (int k : {0, 1}) {
                const double weight = k == 1 ? dt * d.weight : 0.0;
                d.v[k] += (d.impulse[k] - before[i].impulse[k] - weight) / d.mass;
                d.x[k] += dt * d.v[k];
            }
        }
    }

    // Step 4: configurations of the start of the window, velocities after the contacts, impulses.
    Motion advance(const Window& window, const std::vector<FreeResponse>&) override {
        deepest = 0;
        for (std::size_t i = 0; i < discs.size(); ++i)
            discs[i].x = state.grains[i].position, discs[i].v = state.grains[i].velocity,
            discs[i].impulse = {};
        for (int k = 0; k < substeps; ++k) substep(window.step / substeps);
        state.report = {};
        state.report.iterations = substeps;
        for (std::size_t i = 0; i < discs.size(); ++i) {
            state.grains[i].velocity = discs[i].v;
            state.grains[i].contact_impulse = discs[i].impulse;
            state.report.contacts += discs[i].impulse != Vec3{};
        }
        return state;
    }

    // In the plane: about z.
    static Quaternion turned(const Quaternion& q, double angle) {
        const double c = std::cos(angle / 2), s = std::sin(angle / 2);
        return {c * q[0] - s * q[3], 0, 0, c * q[3] + s * q[0]};
    }

    // Corrected velocities; grains without a contact move with them over the whole window.
    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        std::unordered_map<GrainId, const Kick*> by_id;
        for (const Kick& kick : kicks) by_id[kick.id] = &kick;
        for (std::size_t i = 0; i < discs.size(); ++i) {
            GrainState& g = state.grains[i];
            if (!kicks.empty())  // none without a fluid
                g.velocity = by_id.at(g.id)->velocity,
                g.angular_velocity = by_id.at(g.id)->angular_velocity;
            g.orientation = turned(g.orientation, window.step * g.angular_velocity[2]);
            const bool touched = discs[i].impulse != Vec3{};
            for (int k : {0, 1})
                g.position[k] =
                    touched ? discs[i].x[k] : g.position[k] + window.step * g.velocity[k];
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
