// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Films of liquid between discs (contact law "lubrication"): the power of the gap is 3/2, and W may
// couple n, t and roll. What films of spheres have in common with them is in film_test.cpp.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "coupler/rigid/vec3.hpp"
#include "films.hpp"
#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"

namespace turbidite::nscd {
namespace {

using scenes::cutoff, scenes::roughness, scenes::settled;

/// Phi(sigma) - Phi(gamma) by Simpson's rule in ln g: the integral of g^{-3/2} - g_c^{-3/2}.
double integral(const Film& film, double sigma) {
    const double from = std::log(std::min(film.gap, film.cutoff));
    const double to = std::log(std::min(sigma, film.cutoff));
    const auto value = [&](double x) {
        return std::exp(x) * (std::exp(-1.5 * x) - std::pow(film.cutoff, -1.5));
    };
    const int parts = 2000;
    const double h = (to - from) / parts;
    double sum = 0.0;
    for (int i = 0; i < parts; ++i) {
        const double x = from + i * h;
        sum += h / 6.0 * (value(x) + 4.0 * value(x + 0.5 * h) + value(x + h));
    }
    return sum;
}

TEST(DiscFilm, ItsImpulseIsTheIntegralOfTheForceOverTheGap) {
    const Film film{2.0, 0.03, 0.1, 0.0, FilmBetween::discs};
    for (const double sigma : {0.001, 0.02, 0.03, 0.07, 0.1, 0.3})
        EXPECT_NEAR(film.way_to(sigma), integral(film, sigma), 1e-8) << sigma;
}

/// r_f at sigma [N s].
double film_impulse(const Film& film, double sigma) {
    return -film.coefficient * film.way_to(sigma);
}

struct RandomFilm {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> any{0.0, 1.0};

    Film operator()(double w) {
        Film film;
        film.between = FilmBetween::discs;
        film.coefficient = std::pow(10.0, 20.0 * any(random) - 10.0) / w;
        film.cutoff = 10.0 * any(random) + 0.1;
        film.gap = 1.5 * film.cutoff * std::pow(10.0, -4.0 * any(random));
        // Above the gap where an impact has the surfaces part by the end.
        film.offset = film.gap * std::pow(10.0, 0.5 - 3.5 * any(random));
        return film;
    }
};

// Over twenty decades of the film's strength: u = b + W r with r the film's at u, or u = 0 and the
// contact carries the rest.
TEST(DiscFilm, AContactIsSolvedExactly) {
    RandomFilm films;
    int closed = 0, closing = 0, open = 0, parting = 0, impacts = 0;
    for (int i = 0; i < 200000; ++i) {
        const double w = std::pow(10.0, 4.0 * films.any(films.random) - 2.0);
        const Film film = films(w);
        const double b = 4.0 * (films.any(films.random) - 0.5) * std::max(film.gap, 0.5);
        const FilmedNormal n = solve_film(film, w, b);
        const double u = b + w * n.impulse, sigma = u + film.offset;
        const double scale = std::abs(b) + film.gap + film.offset;
        ASSERT_GE(u, -1e-14 * scale) << i;
        ASSERT_GE(n.contact, 0.0);
        if (u < 1e-12 * scale) {
            const double film_alone = film_impulse(film, film.offset);
            ASSERT_GE(n.impulse, film_alone - 1e-11 * (std::abs(film_alone) + scale / w)) << i;
            ASSERT_NEAR(n.contact, std::max(n.impulse - std::max(film_alone, 0.0), 0.0),
                        1e-12 * (std::abs(film_alone) + n.impulse));
            closed += n.contact > 0.0, impacts += n.contact > 0.0 && film_alone < 0.0;
            continue;
        }
        ASSERT_EQ(n.contact, 0.0) << i;
        ++(n.impulse == 0.0 ? open : n.impulse > 0.0 ? closing : parting);
        // Between a slightly larger and a slightly smaller sigma the film's impulse passes r_n.
        const double slack = 1e-11 * scale;
        const double above = film_impulse(film, std::max(sigma - slack, 1e-12 * sigma));
        const double below = film_impulse(film, sigma + slack);
        const double rounding = 1e-11 * (std::abs(above) + std::abs(below) + scale / w);
        ASSERT_LE(n.impulse, above + rounding) << i;
        ASSERT_GE(n.impulse, below - rounding) << i;
    }
    for (const int count : {closed, closing, open, parting, impacts}) EXPECT_GT(count, 1000);
}

// Any W, with friction and rolling resistance: the film alone, without a tangential impulse, or a
// closed contact that obeys both limits by what it carries.
TEST(DiscFilm, AContactWithAnyWIsSolvedExactly) {
    RandomFilm films;
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int filmed = 0, sticks = 0, slides = 0;
    for (int i = 0; i < 100000; ++i) {
        Eigen::Matrix3d a;
        for (int k = 0; k < 9; ++k) a(k) = any(films.random);
        const Eigen::Matrix3d s = a * a.transpose() + 0.05 * Eigen::Matrix3d::Identity();
        const Film film = films(s(0, 0));
        Block w{s(0, 0), s(0, 1), s(1, 1), s(0, 2), s(1, 2), s(2, 2), &film};
        const double size = std::max(film.gap, 0.5);
        const ContactVector b = in_plane(size * (any(films.random) - 0.5), size * any(films.random),
                                         size * any(films.random));
        // Stronger friction may have several solutions (painleve_test.cpp).
        const double mu = 0.2 * (1.0 + any(films.random)), rho = 0.1 * (1.0 + any(films.random));
        const ContactVector r = solve_filmed_contact(w, b, mu, rho), u = b + product(w, r);
        const double scale =
            norm(Vec3{b.n, b.t, b.roll}) + film.gap + film.offset + w.nn * std::abs(film.closed());
        ASSERT_GE(u.n, -1e-10 * scale) << i;
        if (r.t == 0.0 && r.roll == 0.0) {
            ++filmed;
            ASSERT_EQ(r.n, solve_film(film, w.nn, b.n).impulse) << i;
            continue;
        }
        const double carried = r.n - film.closed();
        const double slack = 1e-9 * (carried + film.closed()), still = 1e-9 * scale;
        ASSERT_NEAR(u.n, 0.0, still) << i;
        ASSERT_GT(carried, 0.0) << i;
        ASSERT_LE(std::abs(r.t), mu * carried + slack) << i;
        ASSERT_LE(std::abs(r.roll), rho * carried + slack) << i;
        // Inside their limits they hold; at them they oppose.
        if (std::abs(r.t) < mu * carried - slack) {
            ++sticks;
            ASSERT_NEAR(u.t, 0.0, still) << i;
        } else {
            ++slides;
            ASSERT_LE(r.t * u.t, still * (std::abs(r.t) + slack)) << i;
        }
        if (std::abs(r.roll) < rho * carried - slack) {
            ASSERT_NEAR(u.roll, 0.0, still) << i;
        } else {
            ASSERT_LE(r.roll * u.roll, still * (std::abs(r.roll) + slack)) << i;
        }
    }
    for (const int count : {filmed, sticks, slides}) EXPECT_GT(count, 1000);
}

EngineSettings filmed(double viscosity, double friction = 0.0, double tolerance = 1e-10) {
    return scenes::with_film(scenes::exact(friction, tolerance), viscosity);
}

/// C for R*, per depth [N s m^{1/2}].
double coefficient(double viscosity, double reduced_radius) {
    return 3.0 * std::numbers::sqrt2 * std::numbers::pi * viscosity * std::pow(reduced_radius, 1.5);
}

/// What the force takes of the speed of a disc at a floor between the cut-off and a gap: C/m (2
/// g^{-1/2} - 3 g_c^{-1/2} + g g_c^{-3/2}).
double speed_lost_between(double gap, double viscosity) {
    return coefficient(viscosity, 0.5) / scenes::disc(1, 0.0, 0.0).mass *
           (2.0 / std::sqrt(gap) - 3.0 / std::sqrt(cutoff) + gap * std::pow(cutoff, -1.5));
}

// m dv/dt = -C (g_h^{-3/2} - g_c^{-3/2}) v with dg/dt = v gives
//     v(g) = v_0 + C/m (2 g_h^{-1/2} - 3 g_c^{-1/2} + g_h g_c^{-3/2})
// for an approach v < 0 that starts at the cut-off: first order in the step.
TEST(DiscFilm, SlowsAnApproachAsTheForceOfLubricationDoes) {
    const double viscosity = 0.01, gap = 0.02;
    const auto speed_at_gap = [&](double dt) {
        EngineSettings settings = filmed(viscosity);
        settings.gravity = {};
        Engine engine(settings, scenes::discs, {scenes::floor(0.0)});
        engine.bodies().add(scenes::disc(1, 0.0, 0.5 + cutoff - roughness));
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
    const double lost = speed_lost_between(gap, viscosity);
    ASSERT_GT(lost, 0.2);
    ASSERT_LT(lost, 0.8);
    const double coarse = std::abs(speed_at_gap(4e-4) - (lost - 1.0));
    const double fine = std::abs(speed_at_gap(1e-4) - (lost - 1.0));
    EXPECT_LT(fine, 2e-3);
    EXPECT_LT(fine, 0.4 * coarse) << coarse;
}

// On its way from the floor to the cut-off a disc loses what the force takes, C/m (2 g^{-1/2} - 3
// g_c^{-1/2} + g g_c^{-3/2}), in steps of any length: the impulse is exact.
TEST(DiscFilm, HoldsBackWhatPartsInAnyStep) {
    const double viscosity = 0.001;
    const double lost = speed_lost_between(roughness, viscosity);
    ASSERT_GT(lost, 0.2);
    ASSERT_LT(lost, 0.5);
    for (const double dt : {0.3, 0.02, 0.001}) {
        EngineSettings settings = filmed(viscosity);
        settings.gravity = {};
        Engine engine(settings, scenes::discs, {scenes::floor(0.0)});
        engine.bodies().add(scenes::disc(1, 0.0, 0.5));
        engine.bodies().twist[0].velocity = {0.0, 1.0, 0.0};
        double lowest = 0.0;
        while (engine.bodies().position[0][1] - 0.5 + roughness < cutoff) {
            engine.step(dt);
            engine.move(dt);
            for (const ContactVector& r : engine.impulses()) lowest = std::min(lowest, r.n);
            EXPECT_LE(engine.film_work(), 0.0);
        }
        EXPECT_NEAR(engine.bodies().twist[0].velocity[1], 1.0 - lost, 1e-12) << dt;
        EXPECT_LT(lowest, 0.0) << "it pulls";
    }
}

// A film as strong as the step is long: no gap overshoots, whatever the viscosity, and a disc that
// lands stays on its asperities.
TEST(DiscFilm, NeverOvershoots) {
    for (const double viscosity : {1e-6, 1e-4, 1.0, 1e3}) {
        Engine engine(filmed(viscosity), scenes::discs, {scenes::floor(0.0)});
        engine.bodies().add(scenes::disc(1, 0.0, 0.55));
        double lowest = 1.0;
        for (int i = 0; i < 300; ++i) {
            ASSERT_TRUE(engine.step(0.01).converged);
            engine.move(0.01);
            lowest = std::min(lowest, engine.bodies().position[0][1] - 0.5);
            ASSERT_LE(engine.bodies().twist[0].velocity[1], 1e-12) << "no bounce";
        }
        EXPECT_GE(lowest, -1e-15) << viscosity;
        if (viscosity <= 1e-4) {
            EXPECT_LT(lowest, 1e-12) << "lands";
        }
        if (viscosity >= 1e3) {
            EXPECT_GT(lowest, 0.045) << "sinks slowly";
        }
    }
}

// Friction is of what the contact carries: a disc held off by its film slides freely, and when it
// has landed it sticks on a slope below mu.
TEST(DiscFilm, FrictionSeesTheContactAlone) {
    EngineSettings settings = filmed(10.0, 0.5);
    settings.gravity = {0.3, -1.0, 0.0};
    Engine engine(settings, scenes::discs, {scenes::floor(0.5)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.51));
    engine.step(0.01);
    EXPECT_GT(engine.impulses()[0].n, 0.0);
    EXPECT_EQ(engine.carried()[0].n, 0.0);
    EXPECT_EQ(engine.impulses()[0].t, 0.0);
    EXPECT_DOUBLE_EQ(engine.bodies().twist[0].velocity[0], 0.003);
    settings.law_settings.viscosity = 1e-4;
    Engine landed(settings, scenes::discs, {scenes::floor(0.5)});
    landed.bodies().add(scenes::disc(1, 0.0, 0.5));
    const StepReport report = landed.step(0.01);
    EXPECT_EQ(report.contacts, 1);
    EXPECT_NEAR(landed.carried()[0].n, landed.impulses()[0].n, 1e-15) << "no film at rest";
    EXPECT_GT(std::abs(landed.impulses()[0].t), 0.0);
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
    Engine engine(settings, scenes::discs, {floor});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5 + cutoff - roughness));
    engine.bodies().twist[0].velocity = {0.0, -1.0, 0.0};
    for (double time = 0.0; time < 3.0; time += dt) {
        engine.step(dt);
        engine.move(dt);
        if (engine.bodies().position[0][1] - 0.5 > cutoff)
            return engine.bodies().twist[0].velocity[1];
    }
    return 0.0;
}

// The film takes its part before and after the impact: with l of it each way, the speed is 0.9 (1 -
// l) - l, to first order in the step; and a film that stops the disc leaves none.
TEST(DiscFilm, ReboundsWithWhatItLeavesOfTheApproach) {
    const double viscosity = 0.0008;
    const double lost = speed_lost_between(roughness, viscosity);
    ASSERT_GT(lost, 0.1);
    const double left = 0.9 * (1.0 - lost) - lost;
    ASSERT_GT(left, 0.3);
    for (const double dt : {0.02, 0.005, 0.001})
        EXPECT_NEAR(rebound(viscosity, dt), left, 0.1) << dt;
    EXPECT_NEAR(rebound(viscosity, 2e-5), left, 1e-2);
    EXPECT_NEAR(rebound(1e-8, 0.005), 0.9, 1e-3);
    EXPECT_LT(rebound(0.01, 0.02), 1e-9) << "stopped by the film";
}

// In the window of an impact, whose rebound is without what the film takes, the contact carries all
// of the impulse: friction has no more than mu of it, and no film works.
TEST(DiscFilm, CarriesNothingInAnImpact) {
    EngineSettings settings = filmed(0.01);
    settings.gravity = {};
    Surface elastic;
    elastic.restitution = 0.5;
    elastic.friction = 0.3;
    settings.surfaces = {elastic};
    Wall floor = scenes::floor(0.3);
    floor.material = 0;
    Engine engine(settings, scenes::discs, {floor});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5));
    engine.bodies().twist[0].velocity = {5.0, -1.0, 0.0};
    engine.step(0.01);
    const ContactVector r = engine.impulses()[0];
    EXPECT_NEAR(r.n, 1.5 * engine.bodies().mass[0], 1e-12);
    EXPECT_EQ(engine.carried()[0].n, r.n);
    EXPECT_NEAR(std::abs(r.t), 0.3 * r.n, 1e-12);
    EXPECT_EQ(engine.film_work(), 0.0);
}

// What films take is the energy that is missing: no contact, no friction, no weight.
TEST(DiscFilm, ItsWorkIsTheEnergyThatIsMissing) {
    EngineSettings settings = filmed(0.02);
    settings.gravity = {};
    Engine engine(settings, scenes::discs, {});
    engine.bodies().add(scenes::disc(1, 0.0, 0.0));
    engine.bodies().add(scenes::disc(2, 1.2, 0.0, 0.6));
    engine.bodies().twist[0].velocity = {0.5, 0.1, 0.0};
    const auto energy = [&] {
        double sum = 0.0;
        for (std::size_t i = 0; i < 2; ++i)
            sum += 0.5 * engine.bodies().mass[i] *
                   dot(engine.bodies().twist[i].velocity, engine.bodies().twist[i].velocity);
        return sum;
    };
    const double before = energy();
    double work = 0.0;
    for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(engine.step(0.01).contacts, 0);
        work += engine.film_work();
        engine.move(0.01);
    }
    EXPECT_LT(work, -0.01 * before);
    EXPECT_NEAR(energy() - before, work, 1e-13);
}

// Contacts work on free bodies alone: so do films. A driven disc pushes a free one, film alone.
TEST(DiscFilm, WorksOnFreeBodiesAlone) {
    EngineSettings settings = filmed(0.02);
    settings.gravity = {};
    Engine engine(settings, scenes::discs, {});
    engine.bodies().add(scenes::disc(1, 0.0, 0.0));
    engine.bodies().add(scenes::disc(2, 1.05, 0.0));
    engine.bodies().fixed[0] = 1;
    engine.bodies().twist[0].velocity = {0.2, 0.0, 0.0};
    double work = 0.0, of_film = 0.0;
    for (int i = 0; i < 20; ++i) {
        const Vec3 before = engine.bodies().twist[1].velocity;
        ASSERT_EQ(engine.step(0.01).contacts, 0);
        // J . (v^- + v^+)/2
        work += 0.5 *
                dot(engine.bodies().contact_impulse[1], before + engine.bodies().twist[1].velocity);
        of_film += engine.film_work();
        engine.move(0.01);
    }
    EXPECT_GT(work, 0.001);
    EXPECT_NEAR(of_film, work, 1e-14);
}

TEST(DiscFilm, WhatSlidesBelowAFilmHasTheLowerFriction) {
    scenes::expect_sliding_friction_below_films(2);
}

EngineSettings with_rolling(EngineSettings settings) {
    Surface surface;
    surface.friction = 0.4;
    surface.rolling_friction = 0.05;
    settings.surfaces = {surface};
    return settings;
}

// In a heap, with and without rolling resistance: converged, admissible, and more films that press
// or pull than contacts. After a restart the next steps have the same bits.
TEST(DiscFilm, AHeapSettlesAndResumesBitForBit) {
    const EngineSettings plain = filmed(0.01, 0.4, 1e-4);
    for (const EngineSettings& settings : {plain, with_rolling(plain)}) {
        Engine engine = scenes::settling_pack(12, 12, settings);
        const StepReport report = settled(engine, 250);
        EXPECT_TRUE(report.converged);
        EXPECT_LE(report.max_penetration, 1e-4);
        const auto count = [&](auto test) {
            return std::count_if(engine.solution().begin(), engine.solution().end(), test);
        };
        EXPECT_GT(report.contacts, 50);
        EXPECT_GT(count([](const ContactVector& r) { return r.n != 0.0; }), report.contacts + 30);
        EXPECT_GT(count([](const ContactVector& r) { return r.n < 0.0; }), 5);
        EXPECT_LT(engine.contact_violation(), 1e-3);
        EXPECT_EQ(natural_map_residual(engine.problem(), engine.solution()), report.residual);
        Engine other = scenes::settling_pack(12, 12, settings);
        other.restore(engine.save());
        settled(engine, 5), settled(other, 5);
        for (std::size_t i = 0; i < engine.bodies().size(); ++i) {
            EXPECT_EQ(engine.bodies().position[i], other.bodies().position[i]);
            EXPECT_EQ(engine.bodies().twist[i].velocity, other.bodies().twist[i].velocity);
        }
    }
}

// A film that is left out changes nothing: the same heap with a viscosity of next to nothing.
TEST(DiscFilm, AThinFilmIsNoFilm) {
    for (const bool rolls : {false, true}) {
        EngineSettings settings = filmed(1e-14, 0.4, 1e-12);
        settings.solver_settings.max_iterations = 100000;
        if (rolls) settings = with_rolling(settings);
        EngineSettings dry = settings;
        dry.law.film = "none";
        Engine with = scenes::settling_pack(4, 4, settings);
        Engine without = scenes::settling_pack(4, 4, dry);
        settled(with, 60), settled(without, 60);
        for (std::size_t i = 0; i < with.bodies().size(); ++i)
            EXPECT_LT(norm(with.bodies().twist[i].velocity - without.bodies().twist[i].velocity),
                      1e-8);
    }
}

TEST(DiscFilm, IsRefusedForPolygonsAndBySolversWithoutFilms) {
    EngineSettings settings = filmed(0.1);
    EXPECT_NO_THROW(Engine(settings, scenes::discs, {}));
    EXPECT_THROW(Engine(settings, {scenes::discs[0], {"triangle", {}}}, {}), std::invalid_argument);
    settings.solver = "central-path";
    EXPECT_THROW(Engine(settings, scenes::discs, {}), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite::nscd
