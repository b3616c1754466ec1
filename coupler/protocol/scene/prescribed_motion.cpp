// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/scene/prescribed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

#include "coupler/protocol/number_text.hpp"
#include "coupler/protocol/scene/sides.hpp"

namespace turbidite {
namespace {

using std::numbers::pi;

/// The numbers of a motion's text, in the plane or in space.
struct MotionNumbers {
    std::vector<double> all;
    int dimension = 2;

    std::size_t per_shift() const { return dimension == 3 ? 6 : 3; }
    double at(std::size_t i) const { return all.at(i); }

    /// Throws std::invalid_argument.
    void require(std::size_t count) const {
        if (all.size() != count)
            throw std::invalid_argument(std::to_string(all.size()) + " numbers, not " +
                                        std::to_string(count));
    }

    /// `X Y ANGLE`, in space `X Y Z AX AY AZ`, from the i-th number on.
    Shift shift(std::size_t i = 0) const {
        if (dimension == 2) return {{at(i), at(i + 1), 0.0}, {0.0, 0.0, at(i + 2)}};
        return {{at(i), at(i + 1), at(i + 2)}, {at(i + 3), at(i + 4), at(i + 5)}};
    }
};

/// `constant VX VY SPIN`.
class Constant final : public PrescribedMotion {
 public:
    explicit Constant(const Twist& rate) : rate_(rate) {}
    explicit Constant(const MotionNumbers& numbers) {
        numbers.require(numbers.per_shift());
        const Shift in_unit_time = numbers.shift();
        // v and w are the displacement and the angle after one unit of time.
        rate_ = {in_unit_time.displacement, in_unit_time.angle};
    }
    Shift at(double time) const override { return time * rate_; }
    // Exactly v and w, and not the rounded difference of two displacements.
    Twist rate(double, double) const override { return rate_; }

 private:
    Twist rate_;
};

/// `harmonic X Y ANGLE PERIOD PHASE`.
class Harmonic final : public PrescribedMotion {
 public:
    explicit Harmonic(const MotionNumbers& numbers) {
        numbers.require(numbers.per_shift() + 2);
        amplitude_ = numbers.shift();
        period_ = numbers.at(numbers.per_shift());
        phase_ = numbers.at(numbers.per_shift() + 1);
    }
    Shift at(double time) const override {
        // d(t) = A (sin(2 pi t/T + phase) - sin(phase)): zero at t = 0 whatever the phase.
        const double angle = 2.0 * pi * time / period_ + phase_;
        return (std::sin(angle) - std::sin(phase_)) * amplitude_;
    }

 private:
    Shift amplitude_;
    double period_ = 1.0;
    double phase_ = 0.0;
};

/// `table T X Y ANGLE T X Y ANGLE ...`, with times ascending from 0.
class Table final : public PrescribedMotion {
 public:
    explicit Table(const MotionNumbers& numbers) {
        const std::size_t per_row = 1 + numbers.per_shift();
        if (numbers.all.empty() || numbers.all.size() % per_row != 0)
            throw std::invalid_argument(per_row == 4
                                            ? "a table has four numbers per row"
                                            : "a table in space has seven numbers per row");
        for (std::size_t i = 0; i < numbers.all.size(); i += per_row)
            rows_.push_back({numbers.at(i), numbers.shift(i + 1)});
    }
    Shift at(double time) const override {
        // The first row later than this time.
        const auto after = std::find_if(rows_.begin(), rows_.end(),
                                        [&](const Row& row) { return row.time > time; });
        if (after == rows_.begin()) return after->shift;
        // After the last row it stands still.
        if (after == rows_.end()) return rows_.back().shift;
        const Row &from = *(after - 1), &to = *after;
        const double part = (time - from.time) / (to.time - from.time);
        // Angles too are interpolated: the turn keeps its axis, so that they are numbers along it.
        return (1.0 - part) * from.shift + part * to.shift;
    }

 private:
    struct Row {
        double time;
        Shift shift;
    };
    std::vector<Row> rows_;
};

template <class Motion>
std::shared_ptr<const PrescribedMotion> make(const MotionNumbers& numbers) {
    return std::make_shared<Motion>(numbers);
}

struct MotionEntry {
    const char* kind;
    std::shared_ptr<const PrescribedMotion> (*make)(const MotionNumbers&);
};
constexpr MotionEntry motion_list[] = {
    {"constant", make<Constant>}, {"harmonic", make<Harmonic>}, {"table", make<Table>}};

/// "2 harmonic 0.1 0 0 3 0".
Moved motion_of(const std::string& text, const std::string& key, int dimension) {
    std::istringstream in(text);
    std::int64_t what = 0;
    std::string kind;
    in >> what >> kind;
    const auto refuse = [&](const std::string& fault) {
        throw std::invalid_argument(key + ": \"" + text + "\" is not a motion: " + fault);
    };
    try {
        const MotionNumbers numbers{remaining_numbers(in), dimension};
        for (const MotionEntry& entry : motion_list)
            if (kind == entry.kind) return {what, entry.make(numbers)};
    } catch (const std::invalid_argument& fault) {
        refuse(fault.what());
    }
    refuse("allowed are constant, harmonic and table with their numbers");
    return {};
}

}  // namespace

Twist PrescribedMotion::rate(double time, double step) const {
    // The mean over the window, not the rate at its start: no drift from the prescribed place.
    const Shift start = at(time), end = at(time + step);
    return {1.0 / step * (end.displacement - start.displacement),
            1.0 / step * (end.angle - start.angle)};
}

std::shared_ptr<const PrescribedMotion> constant_motion(const Twist& rate) {
    return std::make_shared<Constant>(rate);
}

std::vector<Moved> motions_of(const Settings& settings, const char* key) {
    std::vector<Moved> moved;
    if (!settings.has(key)) return moved;
    const int dimension = dimension_of(settings);
    std::istringstream list(settings.text(key));
    for (std::string text; std::getline(list, text, ';');)
        moved.push_back(motion_of(text, key, dimension));
    return moved;
}

}  // namespace turbidite
