// SPDX-License-Identifier: LGPL-2.1-or-later
//
// contact-grains FAULT RUN: discs between four walls with Coulomb friction and perfectly plastic
// contacts, by Gauss-Seidel over the contacts found at q^n. With FAULT none it conforms; any other
// is one that `turbidite adapter-test` must find.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <unordered_map>

#include "coupler/participant/participant.hpp"
#include "coupler/protocol/wire.hpp"
#include "coupler/shapes/immersed_bodies.hpp"

namespace {

using namespace turbidite;

constexpr int sweeps = 100;

/// b may touch a grain a or a wall; normal from a to b.
struct Pair {
    std::int64_t a = -1;  ///< place of the grain; -1: a wall
    std::size_t b = 0;
    int wall = -1;
    double nx = 0.0, ny = 0.0, gap = 0.0;
    double late = 0.0;                      ///< overlap from which it acts; negative: gap
    double normal = 0.0, tangential = 0.0;  ///< impulses on b
};

class ContactGrains final : public GrainsAdapter {
 public:
    explicit ContactGrains(std::string fault) : fault_(std::move(fault)) {}

    Hello describe() const override {
        Hello hello;
        hello.adapter = "contact-grains";
        hello.host_code = "test";
        hello.capabilities.shapes = {"disc"};
        hello.capabilities.saves_state = true;
        return hello;
    }

    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override {
        refuse(settings);
        run_ = run_values(settings);
        bodies_ = ImmersedBodies(run_, shapes);
        friction_ = settings.real("contact.friction");
        if (fault("slippery")) friction_ = 0.0;
        if (fault("rough")) friction_ *= 2.0;
        state_.grains = grains;
        return state_;
    }

    Motion advance(const Window& window, const std::vector<FreeResponse>&) override {
        for (GrainState& grain : state_.grains) {
            grain.contact_impulse = grain.contact_angular_impulse = {};
            if (!is_free(grain)) continue;
            const ImmersedBody body = bodies_(grain);
            grain.velocity[1] -=
                body.submerged_mass / body.effective_mass * run_.gravity * window.step;
        }
        find_pairs();
        for (int sweep = 0; sweep < sweeps; ++sweep)
            for (Pair& pair : pairs_) update(pair, window.step);
        if (fault("never rests")) drive_along_the_floor();
        state_.report = {};
        state_.contacts.reset();
        return state_;
    }

    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        std::unordered_map<GrainId, const Kick*> by_id;
        for (const Kick& kick : kicks) by_id[kick.id] = &kick;
        if (window.write_output) state_.contacts = records();
        const double share = fault("goes half") ? 0.5 : 1.0;
        for (GrainState& grain : state_.grains) {
            if (!kicks.empty()) {
                grain.velocity = by_id.at(grain.id)->velocity;
                grain.angular_velocity = by_id.at(grain.id)->angular_velocity;
            }
            for (std::size_t axis : {0, 1})
                grain.position[axis] += share * window.step * grain.velocity[axis];
            turn(grain.orientation, window.step * grain.angular_velocity[2]);
        }
        find_pairs();
        for (const Pair& pair : pairs_)
            if (!fault("hides overlap"))
                state_.report.max_penetration =
                    std::max(state_.report.max_penetration, pair.late - pair.gap);
        return state_;
    }

    SavedState save() const override {
        if (fault("cannot save")) throw std::runtime_error("there is no room for the state");
        return encode(state_);
    }
    void restore(const SavedState& state) override { state_ = decode<Motion>(state); }

 private:
    bool fault(const char* name) const { return fault_ == name; }

    void refuse(const Settings& settings) const {
        if (settings.integer("grains.ranks") > 1) {
            if (fault("crashes on two ranks")) std::abort();
            throw std::runtime_error("one rank only: grains.ranks");
        }
        if (settings.text("domain.right") != "wall") {
            if (fault("exits with free sides")) std::exit(1);
            throw std::runtime_error("walls only: domain.right");
        }
        if (fault("refuses friction") && settings.real("contact.friction") > 0.0)
            throw std::runtime_error("no friction: contact.friction");
    }

    bool is_free(const GrainState& grain) const { return !grain.prescribed || fault("moves all"); }
    double inverse_mass(std::size_t i) const {
        const GrainState& grain = state_.grains[i];
        return is_free(grain) ? 1.0 / bodies_(grain).effective_mass : 0.0;
    }
    double inverse_inertia(std::size_t i) const {
        const GrainState& grain = state_.grains[i];
        return is_free(grain) ? 1.0 / bodies_(grain).effective_inertia(2, 2) : 0.0;
    }

    /// Overlap [m] from which contacts act.
    double late(const Pair& pair) const {
        if (fault("soft")) return 0.1;
        if (fault("high floor") && pair.wall == 2) return -0.2;
        if (fault("one sinks") && pair.wall == 2 && state_.grains[pair.b].id == 8) return 0.12;
        return fault("hides overlap") ? 0.03 : 0.0;
    }

    void find_pairs() {
        pairs_.clear();
        const auto& grains = state_.grains;
        for (std::size_t b = 0; b < grains.size(); ++b) {
            const double r = grains[b].radius, x = grains[b].position[0], y = grains[b].position[1];
            add({-1, b, 0, 1.0, 0.0, x - r}), add({-1, b, 1, -1.0, 0.0, run_.size[0] - x - r});
            add({-1, b, 2, 0.0, 1.0, y - r}), add({-1, b, 3, 0.0, -1.0, run_.size[1] - y - r});
            for (std::size_t a = 0; a < grains.size(); ++a) {
                if (grains[a].id >= grains[b].id) continue;
                const double dx = x - grains[a].position[0], dy = y - grains[a].position[1];
                const double d = std::hypot(dx, dy);
                add({static_cast<std::int64_t>(a), b, -1, dx / d, dy / d,
                     d - r - grains[a].radius});
            }
        }
    }
    void add(Pair pair) {
        pair.late = late(pair);
        pair.gap += pair.late;
        if (pair.gap < 0.2) pairs_.push_back(pair);
    }

    /// Velocity of b at the contact less that of a, along (x, y) with the arms of both surfaces.
    double relative(const Pair& pair, double x, double y, bool spins) const {
        const GrainState& b = state_.grains[pair.b];
        double u = b.velocity[0] * x + b.velocity[1] * y;
        // Tangent t = (-n_y, n_x), arm of b is -R n: spin moves its surface by -R omega along t.
        if (spins) u -= b.radius * b.angular_velocity[2];
        if (pair.a < 0) return u;
        const GrainState& a = state_.grains[static_cast<std::size_t>(pair.a)];
        return u - a.velocity[0] * x - a.velocity[1] * y -
               (spins ? a.radius * a.angular_velocity[2] : 0.0);
    }

    void update(Pair& pair, double step) {
        const std::size_t a = static_cast<std::size_t>(std::max<std::int64_t>(pair.a, 0));
        const bool wall = pair.a < 0;
        const double tx = -pair.ny, ty = pair.nx;
        const auto arm2 = [&](std::size_t i) {
            return state_.grains[i].radius * state_.grains[i].radius * inverse_inertia(i);
        };
        const double w_n = inverse_mass(pair.b) + (wall ? 0.0 : inverse_mass(a));
        const double w_t = w_n + arm2(pair.b) + (wall ? 0.0 : arm2(a));
        if (w_n == 0.0) return;
        const double u_n = relative(pair, pair.nx, pair.ny, false) + pair.gap / step;
        const double normal = std::max(0.0, pair.normal - u_n / w_n);
        push(pair, (normal - pair.normal) * pair.nx, (normal - pair.normal) * pair.ny, 0.0);
        pair.normal = normal;
        const double bound = friction_ * normal;
        const double tangential =
            std::clamp(pair.tangential - relative(pair, tx, ty, true) / w_t, -bound, bound);
        const double change = tangential - pair.tangential;
        push(pair, change * tx, change * ty, change);
        pair.tangential = tangential;
    }

    /// The impulse (x, y) on b and its negative on a; `along` is its tangential part.
    void push(const Pair& pair, double x, double y, double along) {
        const bool first_only = fault("one spin"), no_spin = fault("no spin");
        push(pair.b, x, y, no_spin || first_only ? 0.0 : -along);
        if (pair.a < 0) return;
        const double share = fault("one-sided") ? 0.6 : 1.0;
        push(static_cast<std::size_t>(pair.a), -share * x, -share * y, no_spin ? 0.0 : -along);
    }
    void push(std::size_t i, double x, double y, double turning) {
        GrainState& grain = state_.grains[i];
        const double moment = grain.radius * turning;
        grain.contact_impulse[0] += x, grain.contact_impulse[1] += y;
        grain.contact_angular_impulse[2] += moment;
        grain.velocity[0] += inverse_mass(i) * x, grain.velocity[1] += inverse_mass(i) * y;
        grain.angular_velocity[2] += inverse_inertia(i) * moment;
    }

    void drive_along_the_floor() {
        for (std::size_t i = 0; i < state_.grains.size(); ++i) {
            const GrainState& grain = state_.grains[i];
            if (grain.contact_impulse[1] > 0.0)
                push(i, (0.1 - grain.velocity[0]) / inverse_mass(i), 0.0, 0.0);
        }
    }

    std::vector<ContactRecord> records() const {
        std::vector<ContactRecord> all;
        const double share = fault("half records") ? 0.5 : 1.0;
        for (const Pair& pair : pairs_) {
            if (pair.normal == 0.0) continue;
            const GrainState& b = state_.grains[pair.b];
            ContactRecord record;
            record.b = b.id;
            if (pair.a >= 0) record.a = state_.grains[static_cast<std::size_t>(pair.a)].id;
            record.wall = pair.wall;
            record.gap = pair.gap;
            record.normal = {pair.nx, pair.ny, 0.0};
            record.point = {b.position[0] - b.radius * pair.nx, b.position[1] - b.radius * pair.ny,
                            0.0};
            // From the centre of a, or of the wall's point
            const double reach = pair.a >= 0 ? 2.0 * b.radius + pair.gap : b.radius;
            if (!fault("no branch")) record.branch = {reach * pair.nx, reach * pair.ny, 0.0};
            record.impulse = {share * (pair.normal * pair.nx - pair.tangential * pair.ny),
                              share * (pair.normal * pair.ny + pair.tangential * pair.nx), 0.0};
            all.push_back(record);
        }
        return all;
    }

    static void turn(Quaternion& q, double angle) {
        const double w = q[0], z = q[3], c = std::cos(angle / 2), s = std::sin(angle / 2);
        q = {c * w - s * z, 0.0, 0.0, c * z + s * w};
    }

    std::string fault_;
    RunValues run_;
    ImmersedBodies bodies_;
    double friction_ = 0.0;
    Motion state_;
    std::vector<Pair> pairs_;
};

}  // namespace

int main(int argc, char** argv) {
    ContactGrains grains(argv[1]);
    return run_grains(grains, {&argc, &argv, argv[argc - 1]});
}
