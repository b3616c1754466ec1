// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/replay/record_numbers.hpp"

#include <cmath>

#include "coupler/protocol/wire.hpp"

namespace turbidite {
namespace {

/// Adds the numbers of one record to its table, with names while the first one is added.
class Entry {
 public:
    Entry(NumberTable& table, GrainId id) : table_(table), named_(!table.ids.empty()) {
        table_.ids.push_back(id);
    }
    void operator()(const std::string& name, double value) {
        if (!named_) table_.names.push_back(name);
        table_.numbers.push_back(value);
    }
    void operator()(const std::string& name, const std::optional<double>& value) {
        // Missing then and now are equal (replay.cpp: NaN is the same as NaN).
        (*this)(name, value.value_or(NAN));
    }
    void operator()(const std::string& name, const Vec3& value) {
        for (int axis = 0; axis < 3; ++axis)
            (*this)(name + " " + "xyz"[axis], value[static_cast<std::size_t>(axis)]);
    }

 private:
    NumberTable& table_;
    bool named_;
};

NumberTable grains(const std::vector<GrainState>& states) {
    NumberTable table{"grain", {}, {}, {}};
    for (const GrainState& grain : states) {
        Entry entry(table, grain.id);
        entry("position", grain.position);
        for (int k = 0; k < 4; ++k)
            entry(std::string("orientation ") + "wxyz"[k],
                  grain.orientation[static_cast<std::size_t>(k)]);
        entry("velocity", grain.velocity);
        entry("angular velocity", grain.angular_velocity);
        entry("contact impulse", grain.contact_impulse);
        entry("contact angular impulse", grain.contact_angular_impulse);
        entry("announced impulse", grain.announced_impulse);
        entry("announced angular impulse", grain.announced_angular_impulse);
        entry("shape", grain.shape);
        entry("material", grain.material);
        entry("prescribed", grain.prescribed ? 1.0 : 0.0);
        entry("radius", grain.radius);
        entry("density", grain.density);
    }
    return table;
}

NumberTable contact_report(const ContactReport& report) {
    NumberTable table{"report", {}, {}, {}};
    Entry entry(table, -1);
    entry("contacts", static_cast<double>(report.contacts));
    entry("iterations", static_cast<double>(report.iterations));
    entry("residual", report.residual);
    entry("converged", report.converged ? 1.0 : 0.0);
    entry("largest overlap", report.max_penetration);
    entry("contact violation", report.contact_violation);
    entry("film work", report.film_work);
    entry("removed grains", static_cast<double>(report.removed));
    entry("Quad", report.quad);
    entry("Max", report.max);
    return table;
}

NumberTable contacts(const std::vector<ContactRecord>& records) {
    NumberTable table{"contact of grain", {}, {}, {}};
    for (const ContactRecord& contact : records) {
        Entry entry(table, contact.b);
        entry("other grain", contact.wall < 0 ? static_cast<double>(contact.a) : NAN);
        entry("wall", contact.wall);
        entry("feature", contact.feature);
        entry("status", contact.status);
        entry("gap", contact.gap);
        entry("length", contact.length);
        entry("point", contact.point);
        entry("normal", contact.normal);
        entry("branch", contact.branch);
        entry("impulse", contact.impulse);
        entry("rolling impulse", contact.rolling_impulse);
    }
    return table;
}

NumberTable kicks_table(const std::vector<Kick>& kicks) {
    NumberTable table{"kick of grain", {}, {}, {}};
    for (const Kick& kick : kicks) {
        Entry entry(table, kick.id);
        entry("velocity", kick.velocity);
        entry("angular velocity", kick.angular_velocity);
        entry("multiplier impulse", kick.multiplier_impulse);
        entry("multiplier angular impulse", kick.multiplier_angular_impulse);
    }
    return table;
}

/// Of a fluid without one all are NaN.
void splitting(Entry& entry, const std::optional<SplittingReport>& report) {
    const auto number = [&](auto value) {
        return report ? std::optional<double>(value(*report)) : std::nullopt;
    };
    using Report = SplittingReport;
    entry("pressure iterations", number([](const Report& r) { return r.pressure_iterations; }));
    entry("viscous iterations", number([](const Report& r) { return r.viscous_iterations; }));
    entry("remaining divergence", number([](const Report& r) { return r.divergence; }));
    entry("viscous residual", number([](const Report& r) { return r.viscous_residual; }));
    entry("splitting converged", number([](const Report& r) { return r.converged ? 1.0 : 0.0; }));
}

NumberTable fluid_report(const FluidReport& report) {
    NumberTable table{"report", {}, {}, {}};
    Entry entry(table, -1);
    entry("multiplier iterations", static_cast<double>(report.multiplier_iterations));
    entry("multiplier residual", report.multiplier_residual);
    entry("multipliers converged", report.multipliers_converged ? 1.0 : 0.0);
    entry("divergence", report.divergence);
    entry("divergence after step 5", report.final_divergence);
    entry("momentum defect", report.momentum_defect);
    entry("Courant number", report.courant);
    splitting(entry, report.splitting);
    entry("mean velocity", report.mean_velocity);
    for (std::size_t k = 0; k < report.probes.size(); ++k)
        entry("probe value " + std::to_string(k), report.probes[k]);
    return table;
}

NumberTable responses(const std::vector<FreeResponse>& list) {
    NumberTable table{"response of grain", {}, {}, {}};
    for (const FreeResponse& response : list) {
        Entry entry(table, response.id);
        entry("velocity", response.velocity);
        entry("angular velocity", response.angular_velocity);
        for (std::size_t k = 0; k < response.inertia.size(); ++k)
            entry("inertia " + std::to_string(k), response.inertia[k]);
        entry("mismatch", response.mismatch);
    }
    return table;
}

NumberTable box(const Box& of_rank) {
    NumberTable table{"domain", {}, {}, {}};
    Entry entry(table, -1);
    entry("lower corner", of_rank.lower);
    entry("upper corner", of_rank.upper);
    return table;
}

std::vector<NumberTable> motion(const Motion& motion) {
    std::vector<NumberTable> tables = {grains(motion.grains), contact_report(motion.report)};
    if (motion.contacts) tables.push_back(contacts(*motion.contacts));
    return tables;
}

std::vector<NumberTable> kicks(const Kicks& kicks) {
    return {kicks_table(kicks.kicks), fluid_report(kicks.report)};
}

}  // namespace

std::vector<NumberTable> numbers_of(const Message& message) {
    switch (message.envelope.kind) {
        case Kind::motion:
        case Kind::state:
            return motion(decode<Motion>(message.payload));
        case Kind::kicks:
            return kicks(decode<Kicks>(message.payload));
        case Kind::response:
            return {responses(decode<std::vector<FreeResponse>>(message.payload))};
        case Kind::domain:
            return {box(decode<Box>(message.payload))};
        default:
            return {};
    }
}

}  // namespace turbidite
