// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A constant attraction c = Surface::adhesion within a distance, g < adhesion_range, shared by the
// points of a pair.
//
//     wet                at any gap below the distance
//     wet-irreversible   contacts within the distance in the first step, until they leave it
#include "granular_adapter/nscd/laws/adhesion_settings.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

class Wet final : public LawPart {
 public:
    /// Throws std::invalid_argument if adhesion or range is missing.
    Wet(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    double range() const override { return range_; }

 private:
    double range_;
};

class WetOnce final : public LawPart {
 public:
    /// Throws std::invalid_argument if adhesion or range is missing.
    WetOnce(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    double remember(const ContactSituation& situation,
                    const ContactOutcome& outcome) const override;
    bool remembers() const override { return true; }
    double range() const override { return range_; }

 private:
    bool wet(const ContactSituation& situation) const;

    double range_;
};

constexpr double dry = 0.0, wetted = 1.0;

double pull(const ContactSituation& situation) {
    return situation.share * situation.surface.adhesion;
}

Wet::Wet(const LawSettings& settings, const SurfaceTable& surfaces)
    : range_(settings.adhesion_range) {
    demand_adhesion("wet", settings, surfaces);
}

void Wet::add(const ContactSituation& situation, LawTerms& terms) const {
    if (situation.gap < range_) terms.attraction = pull(situation);
}

WetOnce::WetOnce(const LawSettings& settings, const SurfaceTable& surfaces)
    : range_(settings.adhesion_range) {
    demand_adhesion("wet-irreversible", settings, surfaces);
}

bool WetOnce::wet(const ContactSituation& situation) const {
    return situation.gap < range_ && (situation.state == wetted || situation.initial);
}

void WetOnce::add(const ContactSituation& situation, LawTerms& terms) const {
    if (wet(situation)) terms.attraction = pull(situation);
}

double WetOnce::remember(const ContactSituation& situation, const ContactOutcome&) const {
    return wet(situation) ? wetted : dry;
}

}  // namespace

std::unique_ptr<const LawPart> make_wet(const LawSettings& settings, const SurfaceTable& surfaces) {
    return std::make_unique<Wet>(settings, surfaces);
}

std::unique_ptr<const LawPart> make_wet_irreversible(const LawSettings& settings,
                                                     const SurfaceTable& surfaces) {
    return std::make_unique<WetOnce>(settings, surfaces);
}

}  // namespace turbidite::nscd
