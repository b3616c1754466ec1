// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/prescribed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

constexpr double pi = 3.14159265358979323846;

Shift operator+(const Shift& a, const Shift& b) {
    Shift sum{a.displacement, a.angle + b.angle};
    for (int axis = 0; axis < 3; ++axis) sum.displacement[axis] += b.displacement[axis];
    return sum;
}

Shift operator*(double factor, const Shift& shift) {
    Shift product{shift.displacement, factor * shift.angle};
    for (double& component : product.displacement) component *= factor;
    return product;
}

/// `constant VX VY SPIN`.
class Constant final : public PrescribedMotion {
 public:
    explicit Constant(const std::vector<double>& numbers)
        : rate_{{numbers.at(0), numbers.at(1), 0.0}, numbers.at(2)} {}
    Shift at(double time) const override { return time * rate_; }
    Shift rate(double, double) const override { return rate_; }

 private:
    Shift rate_;
};

/// `harmonic X Y ANGLE PERIOD PHASE`.
class Harmonic final : public PrescribedMotion {
 public:
    explicit Harmonic(const std::vector<double>& numbers)
        : amplitude_{{numbers.at(0), numbers.at(1), 0.0}, numbers.at(2)},
          period_(numbers.at(3)),
          phase_(numbers.at(4)) {}
    Shift at(double time) const override {
        const double angle = 2.0 * pi * time / period_ + phase_;
        return (std::sin(angle) - std::sin(phase_)) * amplitude_;
    }

 private:
    Shift amplitude_;
    double period_;
    double phase_;
};

/// `table T X Y ANGLE T X Y ANGLE ...`, with times ascending from 0.
class Table final : public PrescribedMotion {
 public:
    explicit Table(const std::vector<double>& numbers) {
        if (numbers.empty() || numbers.size() % 4 != 0)
            throw std::invalid_argument("a table has four numbers per row");
        for (std::size_t i = 0; i < numbers.size(); i += 4)
            rows_.push_back({numbers[i], {{numbers[i + 1], numbers[i + 2], 0.0}, numbers[i + 3]}});
    }
    Shift at(double time) const override {
        const auto after = std::find_if(rows_.begin(), rows_.end(),
                                        [&](const Row& row) { return row.time > time; });
        if (after == rows_.begin()) return after->shift;
        if (after == rows_.end()) return rows_.back().shift;
        const Row &from = *(after - 1), &to = *after;
        const double part = (time - from.time) / (to.time - from.time);
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
std::shared_ptr<const PrescribedMotion> make(const std::vector<double>& numbers) {
    return std::make_shared<Motion>(numbers);
}

struct MotionEntry {
    const char* kind;
    std::shared_ptr<const PrescribedMotion> (*make)(const std::vector<double>&);
};
constexpr MotionEntry motion_list[] = {
    {"constant", make<Constant>}, {"harmonic", make<Harmonic>}, {"table", make<Table>}};

/// "2 harmonic 0.1 0 0 3 0".
Moved motion_of(const std::string& text, const std::string& key) {
    std::istringstream in(text);
    std::int64_t what = 0;
    std::string kind;
    in >> what >> kind;
    std::vector<double> numbers;
    for (double number; in >> number;) numbers.push_back(number);
    for (const MotionEntry& entry : motion_list)
        if (kind == entry.kind && in.eof()) return {what, entry.make(numbers)};
    throw std::invalid_argument(
        key + ": \"" + text +
        "\" is not a motion: allowed are constant, harmonic and table with their numbers");
}

}  // namespace

Shift PrescribedMotion::rate(double time, double step) const {
    return (1.0 / step) * (at(time + step) + -1.0 * at(time));
}

std::shared_ptr<const PrescribedMotion> constant_motion(const Vec3& velocity, double spin) {
    return std::make_shared<Constant>(std::vector<double>{velocity[0], velocity[1], spin});
}

std::vector<Moved> motions_of(const Settings& settings, const char* key) {
    std::vector<Moved> moved;
    if (!settings.has(key)) return moved;
    std::istringstream list(settings.text(key));
    for (std::string text; std::getline(list, text, ';');) moved.push_back(motion_of(text, key));
    return moved;
}

}  // namespace turbidite
