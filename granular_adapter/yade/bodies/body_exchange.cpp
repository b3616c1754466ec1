// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/bodies/body_exchange.hpp"

#include <utility>

#include "coupler/protocol/failure.hpp"

namespace turbidite::yade {
namespace {

template <class Value>
void keep_entries(std::vector<Value>& values, const std::vector<std::uint8_t>& mask) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (mask[i]) values[kept++] = values[i];
    values.resize(kept);
}

}  // namespace

BodyExchange::BodyExchange(const boost::python::object& states, std::vector<Turn> turns,
                           std::size_t grains)
    : states_(states), turns_(std::move(turns)) {
    if (states_.size() != grains)
        throw Failure(ExitCode::participant_failed,
                      "YADE's scene has " + std::to_string(states_.size()) + " grains, the case " +
                          std::to_string(grains));
}

bool BodyExchange::is_as_written(std::size_t i, const BodyMotion& motion) const {
    return !written_.empty() && motion == written_[i];
}

void BodyExchange::read(nscd::Bodies& bodies) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const BodyMotion motion = states_.read(i);
        // Rotating to YADE's axes and back would round.
        if (is_as_written(i, motion)) continue;
        bodies.position[i] = motion.position;
        bodies.orientation[i] = outline_orientation(motion.orientation, turn(i));
        bodies.twist[i] = motion.twist;
    }
}

void BodyExchange::write(const nscd::Bodies& bodies) {
    written_.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        // Kept as written, to tell later what others have changed.
        written_.push_back({bodies.position[i], yade_orientation(bodies.orientation[i], turn(i)),
                            bodies.twist[i]});
        states_.write(i, written_.back());
    }
}

std::optional<std::size_t> BodyExchange::moved() const {
    for (std::size_t i = 0; i < written_.size(); ++i)
        if (!is_as_written(i, states_.read(i))) return i;
    return std::nullopt;
}

void BodyExchange::keep(const std::vector<std::uint8_t>& mask) {
    states_.keep(mask);
    keep_entries(turns_, mask);
    keep_entries(written_, mask);
}

}  // namespace turbidite::yade
