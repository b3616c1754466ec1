// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A constant pull c = Surface::adhesion within a distance, g < adhesion_range, shared by the points
// of a pair.
//
//     wet                whenever the gap is smaller
//     wet-irreversible   contacts within the distance in the first step, until they leave it
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

class Wet final : public LawPart {
 public:
    /// Throws std::invalid_argument when adhesion or range is missing.
    Wet(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    double range() const override { return range_; }

 private:
    double range_;
};

class WetOnce final : public LawPart {
 public:
    /// Throws std::invalid_argument when adhesion or range is missing.
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

}  // namespace turbidite::nscd
