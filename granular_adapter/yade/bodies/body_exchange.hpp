// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exchange between an adapter's grains and the YADE bodies that represent them: motion is read
// before the adapter works and written after it.
#pragma once

#include <boost/python/object.hpp>
#include <optional>
#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/yade/bodies/turn.hpp"
#include "granular_adapter/yade/bodies/yade_bodies.hpp"

namespace turbidite::yade {

class BodyExchange {
 public:
    BodyExchange() = default;

    /// `states`: YADE's states, one per grain, in the order of the `grains` grains. `turns`: as
    /// many, or empty if all are discs. Throws Failure if the number of states differs.
    BodyExchange(const boost::python::object& states, std::vector<Turn> turns, std::size_t grains);

    /// Reads the motion of every body that differs from what was last written.
    void read(nscd::Bodies& bodies) const;

    void write(const nscd::Bodies& bodies);

    /// The first body that was moved by others since the last write.
    std::optional<std::size_t> moved() const;

    /// Drops the bodies whose entry is zero.
    void keep(const std::vector<std::uint8_t>& mask);

    Vec3 position(std::size_t i) const { return states_.read(i).position; }

 private:
    Turn turn(std::size_t i) const { return turns_.empty() ? Turn{} : turns_[i]; }
    bool is_as_written(std::size_t i, const BodyMotion& motion) const;

    BodyStates states_;
    std::vector<Turn> turns_;
    std::vector<BodyMotion> written_;  ///< last motion written, by body; empty if none
};

}  // namespace turbidite::yade
