// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Films of liquid between spheres (contact law "lubrication"): a second relation between normal
// velocity and impulse, solved exactly for each contact and at the gap at the end of the step.
#include <gtest/gtest.h>

#include "films.hpp"
#include "granular_adapter/nscd/problem/film.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "spheres.hpp"

namespace turbidite::nscd {
namespace {

using scenes::cutoff, scenes::roughness, scenes::settled;

/// r_f at sigma, from its definition [N s].
double film_impulse(const Film& film, double sigma) {
    if (sigma >= film.cutoff) return 0.0;
    return -film.coefficient * (1.0 / sigma - 1.0 / film.cutoff) * (sigma - film.gap);
}

// Over twenty decades of the film's strength: u = b + W r with r the film's at u, or u = 0 and the
// contact carries the rest.
TEST(Film, AContactIsSolvedExactly) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    int closed = 0, filmed = 0, open = 0, parting = 0;
    for (int i = 0; i < 200000; ++i) {
        const double w = std::pow(10.0, 4.0 * any(random) - 2.0);
        Film film;
        film.coefficient = std::pow(10.0, 20.0 * any(random) - 10.0) / w;
        film.cutoff = 10.0 * any(random) + 0.1;
        film.gap = film.cutoff * std::pow(10.0, -4.0 * any(random));
        film.offset = film.gap * std::pow(10.0, -3.0 * any(random));
        const double b = 4.0 * (any(random) - 0.5) * std::max(film.gap, 0.5);
        const FilmedNormal n = solve_film(film, w, b);
        const double u = b + w * n.impulse, sigma = u + film.offset;
        const double scale = std::abs(b) + film.gap + film.offset;
        ASSERT_GE(u, -1e-14 * scale) << i;
        ASSERT_GE(n.contact, 0.0);
        if (n.contact > 0.0) {
            ++closed;
            ASSERT_NEAR(u, 0.0, 1e-14 * scale) << i;
            ASSERT_NEAR(n.impulse, n.contact + film.closed(),
                        1e-12 * (std::abs(film.closed()) + n.contact));
            continue;
        }
        sigma >= film.cutoff ? ++open : ++filmed;
        parting += n.impulse < 0.0;
        // Between a slightly larger and a slightly smaller sigma the film's impulse passes r_n.
        const double slack = 1e-11 * scale;
        const double above = film_impulse(film, std::max(sigma - slack, 1e-12 * sigma));
        const double below = film_impulse(film, sigma + slack);
        const double rounding = 1e-11 * (std::abs(above) + std::abs(below) + scale / w);
        ASSERT_LE(n.impulse, above + rounding) << i;
        ASSERT_GE(n.impulse, below - rounding) << i;
    }
    for (const int count : {closed, filmed, open, parting}) EXPECT_GT(count, 1000);
}

EngineSettings filmed(double viscosity, double friction = 0.0, double tolerance = 1e-10) {
    return scenes::with_film(scenes::exact_in_space(friction, tolerance), viscosity);
}

/// C for R* [N s].
double coefficient(double viscosity, double reduced_radius) {
    return 6.0 * std::numbers::pi * viscosity * reduced_radius * reduced_radius;
}

// m dv/dt = -C (1/g_h - 1/g_c) v with dg/dt = v gives v(g) = v_0 + C/m (ln(g_c/g_h) - 1 + g_h/g_c)
// for an approach v < 0 that starts at the cut-off: first order in the step.
TEST(Film, SlowsAnApproachAsTheForceOfLubricationDoes) {
    const double viscosity = 0.05, gap = 0.02;
    const auto speed_at_gap = [&](double dt) {
        EngineSettings settings = filmed(viscosity);
        settings.gravity = {};
        Engine engine(settings, scenes::spheres, {scenes::floor(0.0)});
        engine.bodies().add(scenes::sphere(1, {0.0, 0.5 + cutoff - roughness, 0.0}));
        engine.bodies().twist[0].velocity = {0.0, -1.0, 0.0};
        double before = 0.0, height = 0.0;
        const auto film = [&] { return engine.bodies().position[0][1] - 0.5 + roughness; };
        while (film() > gap) {
            before = engine.bodies().twist[0].velocity[1], height = film();
            engine.step(dt);
            engine.move(dt);
        }
        const double share = (height - gap) / (height - film());
        return before + share * (engine.bodies().twist[0].velocity[1] - before);
    };
    const double mass = scenes::sphere(1, {}).mass, c = coefficient(viscosity, 0.5);
    const double exact = -1.0 + c / mass * (std::log(cutoff / gap) - 1.0 + gap / cutoff);
    ASSERT_GT(exact, -0.7);
    ASSERT_LT(exact, -0.2);
    const double coarse = std::abs(speed_at_gap(4e-4) - exact);
    const double fine = std::abs(speed_at_gap(1e-4) - exact);
    EXPECT_LT(fine, 2e-3);
    EXPECT_LT(fine, 0.4 * coarse) << coarse;
}

// Spheres that part are held back, with the force at the gap at the end of the step.
TEST(Film, HoldsBackWhatParts) {
    EngineSettings settings = filmed(0.02);
    settings.gravity = {};
    Engine engine(settings, scenes::spheres, {});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.0, 0.0}));
    engine.bodies().add(scenes::sphere(2, {1.005, 0.0, 0.0}));
    engine.bodies().twist[1].velocity = {1.0, 0.0, 0.0};
    engine.step(1e-4);
    ASSERT_EQ(engine.points().size(), 1u);
    EXPECT_LT(engine.impulses()[0].n, 0.0);
    EXPECT_EQ(engine.carried()[0].n, 0.0);
    const double one = engine.bodies().twist[0].velocity[0];
    const double other = engine.bodies().twist[1].velocity[0];
    const double film = 0.005 + roughness + 1e-4 * (other - one);
    const double c = coefficient(0.02, 0.25);  // R* of two spheres of radius 0.5
    EXPECT_NEAR(engine.impulses()[0].n, -1e-4 * c * (1.0 / film - 1.0 / cutoff) * (other - one),
                1e-14);
    EXPECT_NEAR(one + other, 1.0, 1e-14);
}

// A film as strong as the step is long: no gap overshoots, whatever the viscosity, and a sphere
// that lands stays on its asperities.
TEST(Film, NeverOvershoots) {
    for (const double viscosity : {1e-6, 1e-3, 1.0, 1e3}) {
        Engine engine(filmed(viscosity), scenes::spheres, {scenes::floor(0.0)});
        engine.bodies().add(scenes::sphere(1, {0.0, 0.55, 0.0}));
        double lowest = 1.0;
        for (int i = 0; i < 300; ++i) {
            ASSERT_TRUE(engine.step(0.01).converged);
            engine.move(0.01);
            lowest = std::min(lowest, engine.bodies().position[0][1] - 0.5);
            ASSERT_LE(engine.bodies().twist[0].velocity[1], 1e-12) << "no bounce";
        }
        EXPECT_GE(lowest, -1e-15) << viscosity;
        if (viscosity <= 1e-3) {
            EXPECT_LT(lowest, 1e-12) << "lands";
        }
        if (viscosity >= 1e3) {
            EXPECT_GT(lowest, 0.045) << "sinks slowly";
        }
    }
}

// Friction is of what the contact carries: a sphere held off by its film slides freely, and when it
// has landed it sticks on a slope below mu.
TEST(Film, FrictionSeesTheContactAlone) {
    EngineSettings settings = filmed(10.0, 0.5);
    settings.gravity = {0.3, -1.0, 0.0};
    Engine engine(settings, scenes::spheres, {scenes::floor(0.5)});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.51, 0.0}));
    engine.step(0.01);
    EXPECT_GT(engine.impulses()[0].n, 0.0);
    EXPECT_EQ(engine.carried()[0].n, 0.0);
    EXPECT_EQ(tangential(engine.impulses()[0]), 0.0);
    EXPECT_DOUBLE_EQ(engine.bodies().twist[0].velocity[0], 0.003);
    EngineSettings thin = settings;
    thin.law_settings.viscosity = 1e-4;
    thin.gravity = {0.3, -1.0, 0.0};
    Engine landed(thin, scenes::spheres, {scenes::floor(0.5)});
    landed.bodies().add(scenes::sphere(1, {0.0, 0.5, 0.0}));
    const StepReport report = landed.step(0.01);
    EXPECT_EQ(report.contacts, 1);
    EXPECT_NEAR(landed.carried()[0].n, landed.impulses()[0].n, 1e-15) << "no film at rest";
    EXPECT_GT(tangential(landed.impulses()[0]), 0.0);
}

/// Speed at the cut-off after a fall at speed 1 from there onto the floor, and a rebound; 0: none.
double rebound(double viscosity, double dt) {
    EngineSettings settings = filmed(viscosity);
    settings.gravity = {};
    Surface elastic;
    elastic.restitution = 0.9;
    settings.surfaces = {elastic};
    Wall floor = scenes::floor(0.0);
    floor.material = 0;
    Engine engine(settings, scenes::spheres, {floor});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.5 + cutoff - roughness, 0.0}));
    engine.bodies().twist[0].velocity = {0.0, -1.0, 0.0};
    for (double time = 0.0; time < 3.0; time += dt) {
        engine.step(dt);
        engine.move(dt);
        if (engine.bodies().position[0][1] - 0.5 > cutoff)
            return engine.bodies().twist[0].velocity[1];
    }
    return 0.0;
}

// The film takes its part before and after the impact, whatever the step: with l of it each way,
// the speed is 0.9 (1 - l) - l; and a film that stops the sphere leaves none.
TEST(Film, ReboundsWithWhatItLeavesOfTheApproach) {
    const double viscosity = 0.008, c = coefficient(viscosity, 0.5);
    const double lost =
        c / scenes::sphere(1, {}).mass * (std::log(cutoff / roughness) - 1.0 + roughness / cutoff);
    ASSERT_GT(lost, 0.1);
    const double left = 0.9 * (1.0 - lost) - lost;
    ASSERT_GT(left, 0.3);
    for (const double dt : {0.02, 0.005, 0.001})
        EXPECT_NEAR(rebound(viscosity, dt), left, 0.06) << dt;
    EXPECT_NEAR(rebound(viscosity, 1e-4), left, 5e-3);
    EXPECT_NEAR(rebound(1e-6, 0.005), 0.9, 1e-3);
    EXPECT_LT(rebound(0.08, 0.02), 1e-9) << "stopped by the film";
}

// What films take is the energy that is missing: no contact, no friction, no weight.
TEST(Film, ItsWorkIsTheEnergyThatIsMissing) {
    EngineSettings settings = filmed(0.2);
    settings.gravity = {};
    Engine engine(settings, scenes::spheres, {});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.0, 0.0}));
    engine.bodies().add(scenes::sphere(2, {1.2, 0.0, 0.0}, 0.6));
    engine.bodies().twist[0].velocity = {0.5, 0.1, 0.0};
    const double before = scenes::kinetic_energy(engine.bodies());
    double work = 0.0;
    for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(engine.step(0.01).contacts, 0);
        work += engine.film_work();
        engine.move(0.01);
    }
    EXPECT_LT(work, -0.01 * before);
    EXPECT_NEAR(scenes::kinetic_energy(engine.bodies()) - before, work, 1e-14);
}

// In a heap: converged, admissible, momentum balanced, and the number of films that press or pull
// is more than that of contacts. After a restart the next steps have the same bits.
TEST(Film, AHeapSettlesAndResumesBitForBit) {
    EngineSettings settings = filmed(0.01, 0.4, 1e-4);
    Engine engine = scenes::settling_spheres(5, 5, settings);
    const StepReport report = settled(engine, 150);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.max_penetration, 1e-4);
    const std::int64_t films = std::count_if(engine.solution().begin(), engine.solution().end(),
                                             [](const ContactVector& r) { return r.n != 0.0; });
    EXPECT_GT(report.contacts, 100);
    EXPECT_GT(films, report.contacts + 50);
    const auto pulls = std::count_if(engine.solution().begin(), engine.solution().end(),
                                     [](const ContactVector& r) { return r.n < 0.0; });
    EXPECT_GT(pulls, 10);
    EXPECT_LT(engine.contact_violation(), 1e-3);
    EXPECT_EQ(natural_map_residual(engine.problem(), engine.solution()), report.residual);
    Engine other = scenes::settling_spheres(5, 5, settings);
    other.restore(engine.save());
    settled(engine, 5), settled(other, 5);
    for (std::size_t i = 0; i < engine.bodies().size(); ++i) {
        EXPECT_EQ(engine.bodies().position[i], other.bodies().position[i]);
        EXPECT_EQ(engine.bodies().twist[i].velocity, other.bodies().twist[i].velocity);
    }
}

// Films that pull are part of the initial guess.
TEST(Film, RemembersWhatPulls) {
    Engine engine = scenes::settling_spheres(5, 5, filmed(0.01, 0.4, 1e-6));
    settled(engine, 60);
    engine.step(0.01);
    const auto pulls = std::count_if(engine.guess().begin(), engine.guess().end(),
                                     [](const ContactVector& r) { return r.n < 0.0; });
    EXPECT_GT(pulls, 5);
}

// A film that is left out changes nothing: the same heap with a viscosity of next to nothing.
TEST(Film, AThinFilmIsNoFilm) {
    EngineSettings settings = filmed(1e-14, 0.4, 1e-12);
    settings.solver_settings.max_iterations = 100000;
    EngineSettings dry = settings;
    dry.law.film = "none";
    Engine with = scenes::settling_spheres(3, 3, settings);
    Engine without = scenes::settling_spheres(3, 3, dry);
    settled(with, 30), settled(without, 30);
    for (std::size_t i = 0; i < with.bodies().size(); ++i)
        EXPECT_LT(norm(with.bodies().twist[i].velocity - without.bodies().twist[i].velocity), 1e-8);
}

TEST(Film, IsRefusedWithoutItsParameters) {
    for (double LawSettings::*missing :
         {&LawSettings::viscosity, &LawSettings::film_cutoff, &LawSettings::film_roughness}) {
        EngineSettings settings = filmed(0.1);
        settings.law_settings.*missing = 0.0;
        EXPECT_THROW(Engine(settings, scenes::spheres, {}), std::invalid_argument);
    }
}

TEST(Film, WhatSlidesBelowAFilmHasTheLowerFriction) {
    scenes::expect_sliding_friction_below_films(3);
}

}  // namespace
}  // namespace turbidite::nscd
