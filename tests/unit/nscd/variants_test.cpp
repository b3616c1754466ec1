// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The cost of a new contact law and a new contact solver: the part itself, one entry of a list, and
// this test. Both are used by the engine through their names, as in a case.
#include <gtest/gtest.h>

#include "granular_adapter/nscd/laws/law_list.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

using scenes::disc, scenes::discs, scenes::exact;

/// Friction of fast contacts only: below the speed there is none.
std::optional<LawPart> make_fast_friction(const LawSettings&, const SurfaceTable&) {
    return LawPart{.add =
                       [](const ContactSituation& s, LawTerms& terms) {
                           terms.friction = s.approach.t > 0.5 ? s.surface.friction : 0.0;
                       },
                   .reads_velocities = true};
}

/// Every contact solved alone, as if there were no others: exact for contacts that share no body.
class OneByOne final : public ContactSolver {
 public:
    SolverResult solve(const ContactProblem& problem, const Impulses&,
                       const SolverSettings&) const override {
        SolverResult result;
        for (const Contact& contact : problem.contacts) {
            ContactProblem alone = problem;
            alone.contacts = {contact};
            const auto solved = make_solver("nlgs")->solve(alone, Impulses(1), {});
            result.impulses.push_back(solved.impulses[0]);
        }
        result.velocities = body_velocities(problem, result.impulses);
        result.residual = natural_map_residual(problem, result.impulses);
        result.iterations = 1;
        return result;
    }
};

std::unique_ptr<const ContactSolver> make_one_by_one() {
    return std::make_unique<OneByOne>();
}

std::vector<LawEntry> with_fast_friction() {
    std::vector<LawEntry> laws(law_list().begin(), law_list().end());
    laws.push_back({LawSlot::friction, "fast", "only fast contacts rub", make_fast_friction});
    return laws;
}

std::vector<SolverEntry> with_one_by_one() {
    std::vector<SolverEntry> solvers(solver_list().begin(), solver_list().end());
    solvers.push_back({"one-by-one", "every contact alone", make_one_by_one});
    return solvers;
}

/// Speed along a floor after one step, of a disc that lies on it.
double slide(double speed, const EngineSettings& settings) {
    Engine engine(settings, discs, {scenes::floor(settings.friction)});
    engine.bodies().add(disc(1, 0.0, 0.5));
    engine.bodies().twist[0].velocity = {speed, 0.0, 0.0};
    engine.step(0.01);
    EXPECT_EQ(engine.points().size(), 1u);
    return engine.bodies().twist[0].velocity[0];
}

TEST(Variants, ALawIsAPartAndAnEntry) {
    const std::vector<LawEntry> laws = with_fast_friction();
    EngineSettings settings = exact(0.3);
    settings.laws = laws;
    settings.law.friction = "fast";
    EXPECT_EQ(slide(0.1, settings), 0.1);
    EXPECT_NEAR(slide(1.0, settings), 1.0 - 0.3 * 0.01, 1e-14);
    EXPECT_LT(slide(0.1, exact(0.3)), 0.1) << "coulomb holds slow ones too";
}

TEST(Variants, ASolverIsAClassAndAnEntry) {
    const std::vector<SolverEntry> solvers = with_one_by_one();
    EngineSettings settings = exact(0.3);
    settings.solvers = solvers;
    settings.solver = "one-by-one";
    Engine engine(settings, discs, {scenes::floor(0.3)});
    engine.bodies().add(disc(1, 0.0, 0.5));
    engine.bodies().add(disc(2, 3.0, 0.5));
    const StepReport report = engine.step(0.01);
    EXPECT_EQ(report.iterations, 1);
    EXPECT_EQ(report.contacts, 2);
    EXPECT_LT(report.residual, 1e-12);
    EXPECT_NEAR(engine.bodies().twist[1].velocity[1], 0.0, 1e-14);
}

TEST(Variants, OthersDoNotKnowThem) {
    EXPECT_THROW(make_solver("one-by-one"), std::invalid_argument);
    EXPECT_THROW(make_law_part(LawSlot::friction, "fast", {}, SurfaceTable({Surface{}})),
                 std::invalid_argument);
}

// The names offered by the case are those of the engine's lists, in the same order.
TEST(ContactNames, AreTheEntriesOfTheLists) {
    std::vector<std::string> offered, known;
    for (std::size_t slot = 0; slot < law_slots; ++slot)
        for (const NamedChoice& choice : law_choices(static_cast<LawSlot>(slot)))
            offered.push_back(slot_name(static_cast<LawSlot>(slot)) + " " + choice.name);
    for (const LawEntry& law : law_list()) known.push_back(slot_name(law.slot) + " " + law.name);
    EXPECT_EQ(offered, known);
    EXPECT_EQ(known.size(), 13u);
    offered.clear(), known.clear();
    for (const NamedChoice& choice : solver_choices()) offered.push_back(choice.name);
    for (const SolverEntry& solver : solver_list()) known.push_back(solver.name);
    EXPECT_EQ(offered, known);
    EXPECT_EQ(known.size(), 2u);
}

}  // namespace
}  // namespace turbidite::nscd
