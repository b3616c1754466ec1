// SPDX-License-Identifier: GPL-3.0-or-later
//
// Grains of an adapter and YADE's bodies that stand for them: motion is read before the adapter
// works and written after it.
#pragma once

#include <boost/python/object.hpp>
#include <optional>
#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/yade/turn.hpp"
#include "granular_adapter/yade/yade_bodies.hpp"

namespace turbidite::yade {

class BodyExchange {
 public:
    BodyExchange() = default;

    /// `states` are YADE's, one for each of `grains` grains in their order, `turns` as long or
    /// empty where all are discs. Throws Failure when there is another number of states.
    BodyExchange(const boost::python::object& states, std::vector<Turn> turns, std::size_t grains);

    /// Takes over the motion of every body that is not as it was written last.
    void read(nscd::Bodies& bodies) const;

    void write(const nscd::Bodies& bodies);

    /// The first body that somebody else has moved since the last write.
    std::optional<std::size_t> moved() const;

    /// Forgets the bodies whose entry is zero.
    void keep(const std::vector<std::uint8_t>& mask);

    Vec3 position(std::size_t i) const { return states_.read(i).position; }

 private:
    Turn turn(std::size_t i) const { return turns_.empty() ? Turn{} : turns_[i]; }
    bool is_as_written(std::size_t i, const BodyMotion& motion) const;

    BodyStates states_;
    std::vector<Turn> turns_;
    std::vector<BodyMotion> written_;  ///< last, by body; empty: nothing yet
};

}  // namespace turbidite::yade
