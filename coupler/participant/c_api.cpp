// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The C interface as an adapter of the C++ one. Fields are copied one by one, so that neither
// interface depends on the other's layout.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "coupler/participant/participant.hpp"
#include "coupler/participant/turbidite.h"
#include "coupler/protocol/files/start_record.hpp"

struct turbidite_settings {
    const turbidite::Settings& values;
    const turbidite::ShapeTable& shapes;
};

struct turbidite_state {
    std::vector<turbidite_grain> grains;
    turbidite_report report{};
    std::optional<std::vector<turbidite_contact>> contacts;
};

struct turbidite_bytes {
    std::vector<char> bytes;
};

namespace turbidite {
namespace {

struct Failing {
    std::string text;
    bool unphysical = false;
};
thread_local Failing failing;  // of the present call

/// What turbidite_fail was told since `failing` was last cleared.
void throw_failure() {
    if (failing.text.empty()) return;
    const Failing told = std::exchange(failing, {});
    if (told.unphysical) throw PhysicsRefused(told.text);
    throw Failure(ExitCode::participant_failed, told.text);
}

template <class From, class To>
void copy(const From& from, To& to) {
    std::copy(std::begin(from), std::end(from), std::begin(to));
}

// Fields with the same name and as many entries on both sides.
template <class From, class To>
void copy_grain(const From& from, To& to) {
    to.id = from.id;
    to.shape = from.shape;
    to.material = from.material;
    to.prescribed = from.prescribed;
    to.radius = from.radius;
    to.density = from.density;
    copy(from.position, to.position);
    copy(from.orientation, to.orientation);
    copy(from.velocity, to.velocity);
    copy(from.angular_velocity, to.angular_velocity);
    copy(from.contact_impulse, to.contact_impulse);
    copy(from.contact_angular_impulse, to.contact_angular_impulse);
    copy(from.announced_impulse, to.announced_impulse);
    copy(from.announced_angular_impulse, to.announced_angular_impulse);
}

turbidite_kick c_record(const Kick& from) {
    turbidite_kick to{};
    to.id = from.id;
    copy(from.velocity, to.velocity);
    copy(from.angular_velocity, to.angular_velocity);
    copy(from.multiplier_impulse, to.multiplier_impulse);
    copy(from.multiplier_angular_impulse, to.multiplier_angular_impulse);
    copy(from.force, to.force);
    copy(from.torque, to.torque);
    return to;
}

turbidite_response c_record(const FreeResponse& from) {
    turbidite_response to{};
    to.id = from.id;
    copy(from.velocity, to.velocity);
    copy(from.angular_velocity, to.angular_velocity);
    copy(from.inertia, to.inertia);
    to.mismatch = from.mismatch;
    return to;
}

turbidite_grain c_record(const GrainState& from) {
    turbidite_grain to{};
    copy_grain(from, to);
    return to;
}

template <class Record>
auto c_records(const std::vector<Record>& records) {
    std::vector<decltype(c_record(records[0]))> result;
    result.reserve(records.size());
    for (const Record& record : records) result.push_back(c_record(record));
    return result;
}

ContactRecord contact(const turbidite_contact& from) {
    ContactRecord to;
    to.a = from.a;
    to.b = from.b;
    to.wall = from.wall;
    to.feature = from.feature;
    to.status = from.status;
    to.gap = from.gap;
    to.length = from.length;
    copy(from.point, to.point);
    copy(from.normal, to.normal);
    copy(from.branch, to.branch);
    copy(from.impulse, to.impulse);
    copy(from.rolling_impulse, to.rolling_impulse);
    return to;
}

turbidite_window c_window(const Window& window) {
    return {window.index, window.time, window.step, window.write_output};
}

// C has no empty values: NaN in a report means that the program does not have the number.
std::optional<double> unless_nan(double value) {
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

Motion motion(const turbidite_state& state) {
    Motion result;
    result.grains.resize(state.grains.size());
    for (std::size_t i = 0; i < state.grains.size(); ++i)
        copy_grain(state.grains[i], result.grains[i]);
    const turbidite_report& report = state.report;
    result.report.contacts = report.contacts;
    result.report.iterations = report.iterations;
    result.report.removed = report.removed;
    result.report.residual = unless_nan(report.residual);
    result.report.max_penetration = report.max_penetration;
    result.report.wall_seconds = report.wall_seconds;
    result.report.converged = report.converged != 0;
    result.report.quad = unless_nan(report.quad);
    result.report.max = unless_nan(report.max);
    result.report.contact_violation = unless_nan(report.contact_violation);
    if (state.contacts) {
        result.contacts.emplace();
        for (const turbidite_contact& each : *state.contacts)
            result.contacts->push_back(contact(each));
    }
    return result;
}

/// The struct of the first header, which has no size in the call.
// Members were added behind those of the first header, never between them.
constexpr std::size_t first_size = offsetof(turbidite_adapter, restores_within_window);
static_assert(offsetof(turbidite_adapter, knows) + sizeof(turbidite_adapter::knows) ==
                  sizeof(turbidite_adapter),
              "padding would be read as a member that follows");

/// Why a struct of this size cannot be used; empty if it can.
std::string refusal(const turbidite_adapter* given, std::size_t size) {
    const char* const bytes = reinterpret_cast<const char*>(given);
    // A program of a newer header may have more members: they are harmless as long as they are
    // zero.
    const bool more = size > sizeof *given && std::any_of(bytes + sizeof *given, bytes + size,
                                                          [](char byte) { return byte != 0; });
    if (size >= first_size && !more) return {};
    return "the turbidite_adapter of the program has " + std::to_string(size) +
           " bytes, this library knows " + std::to_string(sizeof *given) +
           (more ? " of them, and the program uses more: it needs a newer library, or one "
                   "turbidite.h for both"
                 : ", and there have never been fewer than " + std::to_string(first_size));
}

/// Members that the program does not know are zero.
turbidite_adapter known_members(const turbidite_adapter* given, std::size_t size) {
    turbidite_adapter known{};
    // Only as many bytes as the program has: an older struct ends earlier.
    std::memcpy(&known, given, std::min(size, sizeof known));
    return known;
}

std::vector<std::string> texts(const char* const* list) {
    std::vector<std::string> result;
    for (; list != nullptr && *list != nullptr; ++list) result.emplace_back(*list);
    return result;
}

/// Of turbidite_adapter::dimensions.
std::int32_t dimension(std::int64_t given) {
    // Zero is also what a program of an older header has: those played in the plane.
    if (given == 0) return 2;
    if (given == TURBIDITE_BOTH_DIMENSIONS) return both_dimensions;
    if (given == 2 || given == 3) return static_cast<std::int32_t>(given);
    throw Failure(ExitCode::handshake_refused,
                  "turbidite_adapter.dimensions = " + std::to_string(given) +
                      "; allowed are 2, 3, TURBIDITE_BOTH_DIMENSIONS (23), and 0, which is 2");
}

class CAdapter final : public GrainsAdapter {
 public:
    CAdapter(const turbidite_adapter* functions, std::size_t size)
        : refusal_(refusal(functions, size)), c_(known_members(functions, size)) {}

    Hello describe() const override {
        // Not in the constructor: here the coupler hears of it, and ends the run for all.
        if (!refusal_.empty()) throw Failure(ExitCode::handshake_refused, refusal_);
        throw_failure();  // in `joined`, or before the program took part
        Hello hello;
        hello.adapter = text(c_.name);
        hello.adapter_version = text(c_.version);
        hello.host_code = text(c_.host_code);
        hello.dimension = dimension(c_.dimensions);
        hello.capabilities.native_substeps = c_.native_substeps != 0;
        hello.capabilities.effective_inertia = c_.effective_inertia != 0;
        hello.capabilities.saves_state = hello.capabilities.serialises_state =
            c_.save != nullptr && c_.restore != nullptr;
        hello.capabilities.restores_within_window = c_.restores_within_window != 0;
        hello.capabilities.shapes = c_.shapes ? texts(c_.shapes) : std::vector<std::string>{"disc"};
        hello.capabilities.contact_laws = texts(c_.contact_laws);
        return hello;
    }

    int run(int* argc, char*** argv, const char* run_folder) {
        Launch launch{argc, argv, run_folder ? run_folder : "", c_.communicator};
        if (c_.joined)
            launch.joined = [this](int communicator) { c_.joined(c_.self, communicator); };
        return run_grains(*this, launch);
    }

    std::optional<Abilities> abilities() const override {
        if (c_.knows == 0) return std::nullopt;
        return abilities_of(c_.knows);
    }

    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override {
        const auto given = c_records(grains);
        const turbidite_settings values{settings, shapes};
        return answer_of("initialise", c_.initialise, &values, given.data(), given.size());
    }

    Motion advance(const Window& window, const std::vector<FreeResponse>& responses) override {
        const auto given = c_records(responses);
        const turbidite_window now = c_window(window);
        return answer_of("advance", c_.advance, &now, given.data(), given.size());
    }

    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        const auto given = c_records(kicks);
        const turbidite_window now = c_window(window);
        return answer_of("apply_kick", c_.apply_kick, &now, given.data(), given.size());
    }

    SavedState save() const override {
        turbidite_bytes state;
        call("save", c_.save, &state);
        return std::move(state.bytes);
    }
    void restore(const SavedState& state) override {
        call("restore", c_.restore, state.data(), state.size());
    }

 private:
    static std::string text(const char* given) { return given ? given : ""; }

    template <class Function, class... Arguments>
    void call(const char* name, Function function, Arguments... arguments) const {
        if (function == nullptr)
            throw std::logic_error(std::string("turbidite_adapter has no function ") + name);
        // The text of an earlier call must not fail this one.
        failing = {};
        const int status = function(c_.self, arguments...);
        // turbidite_fail counts whatever the function returns; a look-up that failed counts like
        // it.
        throw_failure();
        if (status != 0)
            throw std::runtime_error(std::string(name) + " returned " + std::to_string(status) +
                                     " without turbidite_fail");
    }

    template <class Function, class... Arguments>
    Motion answer_of(const char* name, Function function, Arguments... arguments) const {
        turbidite_state answer;
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        // What the program does not fill in: no counts, nothing measured, converged.
        answer.report = {0, 0, 0, none, 0.0, 0.0, 1, none, none, none};
        call(name, function, arguments..., &answer);
        return motion(answer);
    }

    std::string refusal_;
    turbidite_adapter c_;
};

/// A look-up that may fail, which becomes the failure of the present call.
template <class Value, class LookUp>
Value value(LookUp look_up, Value fallback) {
    try {
        return look_up();
    } catch (const std::exception& error) {
        if (failing.text.empty()) failing.text = error.what();
        return fallback;
    }
}

}  // namespace
}  // namespace turbidite

extern "C" {

int turbidite_has(const turbidite_settings* settings, const char* key) {
    return settings->values.has(key);
}

double turbidite_real(const turbidite_settings* settings, const char* key) {
    return turbidite::value([&] { return settings->values.real(key); }, 0.0);
}

int64_t turbidite_integer(const turbidite_settings* settings, const char* key) {
    return turbidite::value([&] { return settings->values.integer(key); }, std::int64_t{0});
}

int turbidite_flag(const turbidite_settings* settings, const char* key) {
    return turbidite::value([&] { return static_cast<int>(settings->values.flag(key)); }, 0);
}

const char* turbidite_text(const turbidite_settings* settings, const char* key) {
    return turbidite::value([&] { return settings->values.text(key).c_str(); }, "");
}

const char* turbidite_key(const turbidite_settings* settings, size_t index) {
    const auto& entries = settings->values.entries();
    return index < entries.size() ? entries[index].first.c_str() : nullptr;
}

turbidite_shape turbidite_shape_at(const turbidite_settings* settings, size_t index) {
    if (index >= settings->shapes.size()) return {nullptr, nullptr, 0};
    const turbidite::ShapeRecord& shape = settings->shapes[index];
    return {shape.kind.c_str(), shape.vertices.data(), shape.vertices.size()};
}

turbidite_grain* turbidite_grains(turbidite_state* state, size_t count) {
    state->grains.assign(count, {});
    return state->grains.data();
}

turbidite_contact* turbidite_contacts(turbidite_state* state, size_t count) {
    return state->contacts.emplace(count).data();
}

void* turbidite_room(turbidite_bytes* state, size_t size) {
    state->bytes.resize(size);
    return state->bytes.data();
}

turbidite_report* turbidite_report_of(turbidite_state* state) {
    return &state->report;
}

void turbidite_fail(const char* text, int unphysical) {
    turbidite::failing = {text && *text ? text : "failure without a text", unphysical != 0};
}

int turbidite_run_grains_sized(const turbidite_adapter* adapter, size_t adapter_size, int* argc,
                               char*** argv, const char* run_folder) {
    return turbidite::CAdapter(adapter, adapter_size).run(argc, argv, run_folder);
}

// For programs of the first header, which was without the macro of this name.
#undef turbidite_run_grains
int turbidite_run_grains(const turbidite_adapter* adapter, int* argc, char*** argv,
                         const char* run_folder) {
    return turbidite_run_grains_sized(adapter, turbidite::first_size, argc, argv, run_folder);
}

void turbidite_before_mpi_init(void) {
    turbidite::note_start(turbidite::StartStep::mpi_init);
}

void turbidite_before_mpi_finalize(void) {
    turbidite::note_start(turbidite::StartStep::end);
}

}  // extern "C"
