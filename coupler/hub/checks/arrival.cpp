// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/checks/arrival.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

constexpr double unit_tolerance = 1e-6;  // of the squared norm of an orientation

template <class Record>
struct Field {
    const char* name;
    Vec3 Record::*vector;
};

constexpr Field<GrainState> grain_fields[] = {
    {"position", &GrainState::position},
    {"velocity", &GrainState::velocity},
    {"angular velocity", &GrainState::angular_velocity},
    {"contact impulse", &GrainState::contact_impulse},
    {"contact angular impulse", &GrainState::contact_angular_impulse},
    {"announced impulse", &GrainState::announced_impulse},
    {"announced angular impulse", &GrainState::announced_angular_impulse}};

constexpr Field<ContactRecord> contact_fields[] = {
    {"point", &ContactRecord::point},
    {"normal", &ContactRecord::normal},
    {"branch", &ContactRecord::branch},
    {"impulse", &ContactRecord::impulse},
    {"rolling impulse", &ContactRecord::rolling_impulse}};

constexpr Field<Kick> kick_fields[] = {
    {"velocity", &Kick::velocity},
    {"angular velocity", &Kick::angular_velocity},
    {"multiplier impulse", &Kick::multiplier_impulse},
    {"multiplier angular impulse", &Kick::multiplier_angular_impulse}};

constexpr Field<FreeResponse> response_fields[] = {
    {"velocity", &FreeResponse::velocity}, {"angular velocity", &FreeResponse::angular_velocity}};

template <class Numbers>
bool finite(const Numbers& numbers) {
    // Tens of numbers per grain and message: one branch per record in the good case.
    double sum = 0.0;  // one test for all: NaN and infinity survive every sum
    for (const double x : numbers) sum += x;
    return std::isfinite(sum);
}

/// The first vector that is not finite, in words; empty if all are finite.
template <class Record, std::size_t n>
std::string not_finite(const Record& record, const Field<Record> (&fields)[n]) {
    double sum = 0.0;
    for (const auto& field : fields)
        for (const double x : record.*field.vector) sum += x;
    if (std::isfinite(sum)) return "";
    for (const auto& [name, vector] : fields)
        if (!finite(record.*vector))
            return fmt::format("{} is not finite: ({})", name, fmt::join(record.*vector, ", "));
    return "";
}

/// The first number that is not finite.
std::string not_finite(const std::initializer_list<std::pair<const char*, double>> numbers) {
    for (const auto& [name, value] : numbers)
        if (!std::isfinite(value)) return fmt::format("{} is not finite: {}", name, value);
    return "";
}

/// The first number that is not finite, or below zero where it counts or measures something.
std::string negative(const std::initializer_list<std::pair<const char*, double>> numbers) {
    for (const auto& [name, value] : numbers) {
        if (!std::isfinite(value)) return fmt::format("{} is not finite: {}", name, value);
        if (value < 0.0) return fmt::format("{} is {}, not a number from 0 on", name, value);
    }
    return "";
}

std::string fault_of(const GrainState& grain) {
    if (const std::string fault = not_finite(grain, grain_fields); !fault.empty()) return fault;
    if (!(grain.radius > 0.0) || !std::isfinite(grain.radius))
        return fmt::format("radius is {}, not a length above 0", grain.radius);
    if (!(grain.density > 0.0) || !std::isfinite(grain.density))
        return fmt::format("density is {}, not a number above 0", grain.density);
    double norm = 0.0;
    for (const double part : grain.orientation) norm += part * part;
    if (std::abs(norm - 1.0) <= unit_tolerance) return "";  // false for NaN
    return fmt::format("orientation is no unit quaternion (w, x, y, z): ({})",
                       fmt::join(grain.orientation, ", "));
}

std::string fault_of(const ContactRecord& contact) {
    if (const std::string fault = not_finite(contact, contact_fields); !fault.empty()) return fault;
    if (const std::string fault = not_finite({{"gap", contact.gap}, {"length", contact.length}});
        !fault.empty())
        return fault;
    double norm = 0.0;
    for (const double part : contact.normal) norm += part * part;
    if (!(std::abs(norm - 1.0) <= unit_tolerance))
        return fmt::format("normal is no unit vector: ({})", fmt::join(contact.normal, ", "));
    // b has the larger id, so that a pair has one name whoever reports it.
    if (contact.wall < 0 && contact.a >= contact.b)
        return fmt::format("a is grain {}, but b is the grain with the larger id", contact.a);
    return negative({{"length", contact.length}});
}

std::string fault_of(const ContactReport& report) {
    for (const auto& [name, count] :
         {std::pair{"contacts", report.contacts}, std::pair{"iterations", report.iterations},
          std::pair{"removed", report.removed}})
        if (count < 0) return fmt::format("number of {} is {}", name, count);
    if (!std::isfinite(report.film_work.value_or(0.0)))
        return fmt::format("film_work is not finite: {}", *report.film_work);
    return negative({{"residual", report.residual.value_or(0.0)},
                     {"quad", report.quad.value_or(0.0)},
                     {"max", report.max.value_or(0.0)},
                     {"max_penetration", report.max_penetration},
                     {"wall_seconds", report.wall_seconds},
                     {"contact_violation", report.contact_violation.value_or(0.0)}});
}

std::string fault_of(const SplittingReport& report) {
    return negative({{"number of pressure iterations", double(report.pressure_iterations)},
                     {"number of viscous iterations", double(report.viscous_iterations)},
                     {"remaining divergence", report.divergence},
                     {"viscous residual", report.viscous_residual}});
}

std::string fault_of(const FluidReport& report) {
    const std::string fault =
        negative({{"number of multiplier iterations", double(report.multiplier_iterations)},
                  {"multiplier residual", report.multiplier_residual},
                  {"divergence", report.divergence},
                  {"final divergence", report.final_divergence},
                  {"momentum defect", report.momentum_defect},
                  {"Courant number", report.courant},
                  {"wall_seconds", report.wall_seconds}});
    if (!fault.empty()) return fault;
    if (!finite(report.mean_velocity))
        return fmt::format("mean velocity is not finite: ({})",
                           fmt::join(report.mean_velocity, ", "));
    if (!finite(report.probes))
        return fmt::format("probes are not finite: ({})", fmt::join(report.probes, ", "));
    // Empty with marchuk-yanenko, which corrects nothing.
    return report.splitting ? fault_of(*report.splitting) : "";
}

std::string fault_of(const FreeResponse& response) {
    const std::string fault = not_finite(response, response_fields);
    if (!fault.empty()) return fault;
    if (!finite(response.inertia)) return "inertia is not finite";
    return not_finite({{"mismatch", response.mismatch}});
}

const std::string no_fault_of_others =
    "All numbers that it had received are finite: its own log may say more, and a smaller "
    "time.step may help.";
const std::string not_filled_in =
    "A grain is answered as it came, with its new motion; see coupler/protocol/records.hpp.";

const std::string against_protocol = "See coupler/protocol/records.hpp.";

/// A motion that has run away, or a record that the program has not made as it should.
const std::string& remedy_of(const std::string& fault, const std::string& of_wrong_records) {
    const bool endless =
        fault.find("not finite") != std::string::npos || fault.find("nan") != std::string::npos;
    return endless ? no_fault_of_others : of_wrong_records;
}

}  // namespace

Arrival::Arrival(const ParticipantLink& from, Kind kind, std::int64_t window)
    : from_(from), kind_(kind), window_(window) {}

void Arrival::refuse(int rank, const std::string& fault, const std::string& remedy) const {
    refuse_from(from_.who(rank), fault, remedy);
}

void Arrival::refuse(const std::string& fault, const std::string& remedy) const {
    refuse_from(from_.program(), fault, remedy);
}

void Arrival::refuse_from(const std::string& who, const std::string& fault,
                          const std::string& remedy) const {
    const std::string when = window_ < 0 ? "at the start" : fmt::format("of window {}", window_);
    throw PhysicsRefused(
        fmt::format("{}: {}, in \"{}\" {}. {}", who, fault, kind_name(kind_), when, remedy));
}

void Arrival::check(int rank, const Motion& share) const {
    for (const GrainState& grain : share.grains)
        if (const std::string fault = fault_of(grain); !fault.empty())
            refuse(rank, fmt::format("grain {}: {}", grain.id, fault),
                   remedy_of(fault, not_filled_in));
    if (const std::string fault = fault_of(share.report); !fault.empty())
        refuse(rank, "report: " + fault, against_protocol);
    if (!share.contacts) return;
    for (const ContactRecord& contact : *share.contacts)
        if (const std::string fault = fault_of(contact); !fault.empty())
            refuse(rank, fmt::format("a contact of grain {}: {}", contact.b, fault),
                   remedy_of(fault, against_protocol));
}

void Arrival::check(int rank, const Kicks& share) const {
    for (const Kick& kick : share.kicks)
        if (const std::string fault = not_finite(kick, kick_fields); !fault.empty())
            refuse(rank, fmt::format("kick for grain {}: {}", kick.id, fault), no_fault_of_others);
    if (const std::string fault = fault_of(share.report); !fault.empty())
        refuse(rank, "report: " + fault, no_fault_of_others);
}

void Arrival::check(int rank, const std::vector<FreeResponse>& share) const {
    for (const FreeResponse& response : share)
        if (const std::string fault = fault_of(response); !fault.empty())
            refuse(rank, fmt::format("response for grain {}: {}", response.id, fault),
                   no_fault_of_others);
}

void Arrival::check(int rank, const Box& box) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(box.lower[axis] <= box.upper[axis]))  // true for NaN
            refuse(rank,
                   fmt::format("box of the rank from ({}) to ({})", fmt::join(box.lower, ", "),
                               fmt::join(box.upper, ", ")),
                   against_protocol);
}

}  // namespace turbidite
