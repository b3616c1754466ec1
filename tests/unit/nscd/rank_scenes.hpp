// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Configurations that are played on one engine or on several ranks that share them, and what is
// compared afterwards.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <set>

#include "memory_exchange.hpp"
#include "spheres.hpp"

namespace turbidite::nscd::scenes {

struct Scene {
    EngineSettings settings;
    ShapeTable shapes = spheres;
    std::vector<Wall> walls;
    Bodies bodies;
    int steps = 60;
    double dt = 0.01;
    std::set<GrainId> leavers = {};  ///< are gone after half of the steps
};

/// What is compared.
struct Played {
    struct Grain {
        Vec3 position{};
        Quaternion orientation{};
        Twist twist;
        Vec3 impulse{}, angular_impulse{};
        friend bool operator==(const Grain& a, const Grain& b) {
            return a.position == b.position && a.orientation == b.orientation &&
                   a.twist == b.twist && a.impulse == b.impulse &&
                   a.angular_impulse == b.angular_impulse;
        }
    };
    std::map<GrainId, Grain> grains;
    std::map<ContactKey, std::pair<ContactVector, Vec3>> impulses;
    std::map<ContactKey, ContactVector> memory;
    std::vector<std::int64_t> iterations;
    std::vector<double> residuals, quads, overlaps, violations;
    std::int64_t contacts = 0;

    // Of the way it was played.
    std::set<GrainId> moved;  ///< bodies that have changed their rank
    std::size_t doubles = 0;  ///< sent in phases
    std::size_t empty_ranks = 0;
};

inline ContactKey key_of(const Engine& engine, const ContactPoint& point) {
    const std::vector<GrainId>& id = engine.bodies_of_points().id;
    if (point.wall >= 0)
        return {engine.walls_of_points()[point.wall].key, id[point.b], 1, point.feature};
    return {id[point.a], id[point.b], 0, point.feature};
}

inline void add_result(const Engine& engine, Played& result) {
    const Bodies& bodies = engine.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        EXPECT_TRUE(
            result.grains
                .emplace(bodies.id[i], Played::Grain{bodies.position[i], bodies.orientation[i],
                                                     bodies.twist[i], bodies.contact_impulse[i],
                                                     bodies.contact_angular_impulse[i]})
                .second);
    for (std::size_t k = 0; k < engine.points().size(); ++k)
        EXPECT_TRUE(
            result.impulses
                .emplace(key_of(engine, engine.points()[k]),
                         std::pair(engine.impulses()[k], world_moment(engine.impulses(), k)))
                .second);
    for (const RememberedContact& contact : engine.memory().contacts())
        EXPECT_TRUE(result.memory.emplace(contact.key, contact.force).second);
}

inline Played play(const Scene& scene, int ranks) {
    Played result;
    std::mutex mutex;
    std::map<GrainId, int> home;
    on_ranks(ranks, [&](MemoryExchange& exchange) {
        Engine engine(scene.settings, scene.shapes, scene.walls);
        engine.bodies() = scene.bodies;
        std::vector<std::uint8_t> mine;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            mine.push_back(static_cast<int>(i) % ranks == exchange.rank());
        if (ranks > 1) engine.bodies().keep(mine), engine.share_with(exchange);
        std::vector<double> overlaps, violations;
        engine.max_penetration();
        for (int step = 0; step < scene.steps; ++step) {
            if (2 * step == scene.steps && !scene.leavers.empty()) {
                std::vector<std::uint8_t> stays;
                for (const GrainId id : engine.bodies().id)
                    stays.push_back(scene.leavers.count(id) == 0);
                engine.keep(stays);
            }
            const StepReport report = engine.step(scene.dt);
            violations.push_back(engine.contact_violation());
            {
                const std::lock_guard lock(mutex);
                for (const GrainId id : engine.bodies().id) {
                    const auto [at, is_new] = home.emplace(id, exchange.rank());
                    if (at->second != exchange.rank()) result.moved.insert(id);
                    at->second = exchange.rank();
                }
                result.contacts += report.contacts;
                if (exchange.rank() == 0) {
                    result.iterations.push_back(report.iterations);
                    result.residuals.push_back(report.residual);
                    result.quads.push_back(report.change.quad);
                }
            }
            if (step + 1 < scene.steps) engine.move(scene.dt);
            if (step + 1 < scene.steps) overlaps.push_back(engine.max_penetration_after_move());
        }
        const std::lock_guard lock(mutex);
        add_result(engine, result);
        for (auto [all, own] :
             {std::pair{&result.overlaps, &overlaps}, std::pair{&result.violations, &violations}}) {
            all->resize(own->size());
            for (std::size_t i = 0; i < own->size(); ++i)
                (*all)[i] = std::max((*all)[i], (*own)[i]);
        }
        result.doubles += exchange.moved();
        result.empty_ranks += engine.bodies().size() == 0;
    });
    return result;
}

inline void expect_equal(const Played& one, const Played& many) {
    EXPECT_EQ(one.iterations, many.iterations);
    EXPECT_EQ(one.residuals, many.residuals);
    EXPECT_EQ(one.quads, many.quads);
    EXPECT_EQ(one.overlaps, many.overlaps);
    EXPECT_EQ(one.violations, many.violations);
    EXPECT_EQ(one.contacts, many.contacts);
    EXPECT_TRUE(one.grains == many.grains);
    EXPECT_TRUE(one.impulses == many.impulses);
    EXPECT_TRUE(one.memory == many.memory);
}

}  // namespace turbidite::nscd::scenes
