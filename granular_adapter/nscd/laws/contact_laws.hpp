// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From contact points to the contact problem: applies the law to every contact with its surfaces
// and state, and updates the states after the solve.
//
// Attraction (law.hpp): the solver finds r~, the bodies feel r = r~ - dt c n. The second term is
// known and is included in the problem's free velocities.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/common_edges.hpp"
#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/laws/contact_states.hpp"
#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// Contact points, with the keys under which their states are kept.
struct DetectedContacts {
    const std::vector<ContactPoint>& points;
    const std::vector<ContactKey>& keys;
    const Bodies& bodies;  ///< velocities at the start of the step
    const std::vector<Wall>& walls;
};

/// What a problem keeps of the detection (contact_problem.hpp).
struct ContactPlaces {
    ContactCells cells;
    const RankPlan* ranks = nullptr;
};

class ContactLaws {
 public:
    /// Throws std::invalid_argument for unknown names, for parameters that are missing or out of
    /// range, and for rolling resistance of shapes with corners.
    ContactLaws(const LawChoice& choice, const LawSettings& settings, SurfaceTable surfaces,
                const ShapeTable& shapes, LawList laws = law_list());

    const ContactLaw& law() const { return law_; }
    const SurfaceTable& surfaces() const { return surfaces_; }

    /// The same laws and states with other surfaces. Throws as the constructor does.
    ContactLaws with(SurfaceTable surfaces) const;

    /// The contact problem of a step, from free velocities without contacts. Throws
    /// std::invalid_argument naming a body or wall whose material is not in the table.
    ContactProblem pose(const DetectedContacts& contacts, const std::vector<Twist>& free,
                        Mobilities mobilities, ContactPlaces places, double step);

    /// r = r~ - dt c n: the impulses on the bodies, from the solution r~ of the last problem [N s].
    Impulses felt(const Impulses& solution) const;

    /// Determines the next states from the solution of the last problem.
    void find_states(const DetectedContacts& contacts, const Impulses& solution);

    ContactStates& states() { return states_; }
    const ContactStates& states() const { return states_; }

 private:
    ContactSituation situation(const DetectedContacts& contacts, const ContactPoint& point) const;
    Surface surface(const DetectedContacts& contacts, const ContactPoint& point) const;
    void pull(ContactProblem& problem) const;
    bool is_round(const Bodies& bodies, std::int32_t body) const;
    bool all_round() const;
    void check_shapes() const;
    std::vector<CommonEdge> edges_of(const DetectedContacts& contacts) const;
    std::vector<double> shares(const std::vector<ContactPoint>& points,
                               const std::vector<CommonEdge>& edges) const;
    void take_states(const DetectedContacts& contacts, const std::vector<CommonEdge>& edges);
    void check_materials(const DetectedContacts& contacts) const;

    LawChoice choice_;
    LawList list_;
    LawSettings settings_;
    SurfaceTable surfaces_;
    std::vector<std::uint8_t> round_;  ///< by shape: whether it is a disc or sphere
    ContactLaw law_;
    ContactStates states_;
    std::vector<ContactState> past_;  ///< where the last problem began, if the law has states
    std::vector<ContactSituation> situations_;  ///< of the last problem, if the law has states
    std::vector<LawTerms> terms_;               ///< of the last problem, if the law has states
    std::vector<double> attraction_;  ///< dt c of the last problem, empty if none attracts [N s]
};

}  // namespace turbidite::nscd
