// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The C interface as an adapter of the C++ one. Fields are copied one by one, so that neither
// interface depends on the other's layout.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "coupler/participant/participant.hpp"
#include "coupler/participant/turbidite.h"

struct turbidite_settings {
    const turbidite::Settings& values;
};

struct turbidite_state {
    std::vector<turbidite_grain> grains;
    turbidite_report report{};
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

turbidite_window c_window(const Window& window) {
    return {window.index, window.time, window.step, window.write_output};
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
    if (!std::isnan(report.residual)) result.report.residual = report.residual;
    result.report.max_penetration = report.max_penetration;
    result.report.wall_seconds = report.wall_seconds;
    result.report.converged = report.converged != 0;
    return result;
}

class CAdapter final : public GrainsAdapter {
 public:
    explicit CAdapter(const turbidite_adapter& functions) : c_(functions) {}

    Hello describe() const override {
        Hello hello;
        hello.adapter = text(c_.name);
        hello.adapter_version = text(c_.version);
        hello.host_code = text(c_.host_code);
        hello.capabilities.native_substeps = c_.native_substeps != 0;
        hello.capabilities.effective_inertia = c_.effective_inertia != 0;
        hello.capabilities.saves_state = hello.capabilities.serialises_state =
            c_.save != nullptr && c_.restore != nullptr;
        if (c_.shapes == nullptr) hello.capabilities.shapes = {"disc"};
        for (auto shape = c_.shapes; shape != nullptr && *shape != nullptr; ++shape)
            hello.capabilities.shapes.push_back(*shape);
        return hello;
    }

    Motion initialise(const Settings& settings, const ShapeTable&,
                      const std::vector<GrainState>& grains) override {
        const auto given = c_records(grains);
        const turbidite_settings values{settings};
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
        failing = {};
        const int status = function(c_.self, arguments...);
        if (failing.unphysical) throw PhysicsRefused(failing.text);
        if (!failing.text.empty()) throw std::runtime_error(failing.text);
        if (status != 0)
            throw std::runtime_error(std::string(name) + " returned " + std::to_string(status) +
                                     " without turbidite_fail");
    }

    template <class Function, class... Arguments>
    Motion answer_of(const char* name, Function function, Arguments... arguments) const {
        turbidite_state answer;
        answer.report = {0, 0, 0, std::nan(""), 0.0, 0.0, 1};
        call(name, function, arguments..., &answer);
        return motion(answer);
    }

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

turbidite_grain* turbidite_grains(turbidite_state* state, size_t count) {
    state->grains.assign(count, {});
    return state->grains.data();
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

int turbidite_run_grains(const turbidite_adapter* adapter, int* argc, char*** argv,
                         const char* run_folder) {
    turbidite::CAdapter grains(*adapter);
    return turbidite::run_grains(grains, {argc, argv, run_folder});
}

}  // extern "C"
