// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every fault of tests/faults/faults.txt in a job of one process, between scripted grains that fall
// and spin and the coupler: none ends as a run that is done, and all programs learn of it.
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "tests/faults/fault_table.hpp"
#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

/// "set", "report.removed", "1".
struct Words {
    std::string verb, field;
    double value = 0.0;

    explicit Words(const std::string& change) {
        std::istringstream in(change);
        std::string number;
        in >> verb >> field >> number;
        value = std::strtod((number.empty() ? field : number).c_str(), nullptr);
    }

    template <class Number>
    void apply_to(Number& number) const {
        const double now = static_cast<double>(number);
        const double changed = verb == "set" ? value : verb == "add" ? now + value : now * value;
        number = static_cast<Number>(changed);
    }
};

/// "position.1" names one number of a vector.
template <class Numbers>
void change_vector(const Words& words, Numbers& numbers) {
    words.apply_to(numbers.at(static_cast<std::size_t>(words.field.back() - '0')));
}

bool names(const Words& words, const std::string& field) {
    return words.field == field || words.field.rfind(field + ".", 0) == 0;
}

void change_field(const Words& words, GrainState& grain) {
    const std::map<std::string, Vec3 GrainState::*> vectors = {
        {"position", &GrainState::position},
        {"velocity", &GrainState::velocity},
        {"angular_velocity", &GrainState::angular_velocity},
        {"contact_impulse", &GrainState::contact_impulse},
        {"contact_angular_impulse", &GrainState::contact_angular_impulse},
        {"announced_impulse", &GrainState::announced_impulse},
        {"announced_angular_impulse", &GrainState::announced_angular_impulse}};
    for (const auto& [name, vector] : vectors)
        if (names(words, name)) return change_vector(words, grain.*vector);
    if (names(words, "orientation")) return change_vector(words, grain.orientation);
    if (words.field == "id") return words.apply_to(grain.id);
    if (words.field == "shape") return words.apply_to(grain.shape);
    if (words.field == "material") return words.apply_to(grain.material);
    if (words.field == "prescribed") return words.apply_to(grain.prescribed);
    if (words.field == "radius") return words.apply_to(grain.radius);
    if (words.field == "density") return words.apply_to(grain.density);
    throw std::logic_error("no field " + words.field);
}

void change_field(const Words& words, ContactReport& report) {
    if (words.field == "report.contacts") return words.apply_to(report.contacts);
    if (words.field == "report.iterations") return words.apply_to(report.iterations);
    if (words.field == "report.removed") return words.apply_to(report.removed);
    if (words.field == "report.wall_seconds") return words.apply_to(report.wall_seconds);
    if (words.field == "report.max_penetration") return words.apply_to(report.max_penetration);
    throw std::logic_error("no field " + words.field);
}

/// Between the first two grains; true but for what `words` change.
void add_contact(const Words& words, Motion& motion) {
    ContactRecord contact;
    contact.a = motion.grains[0].id, contact.b = motion.grains[1].id;
    contact.normal = {1.0, 0.0, 0.0};
    if (words.field == "contact.a") words.apply_to(contact.a);
    if (words.field == "contact.b") words.apply_to(contact.b);
    if (words.field == "contact.gap") words.apply_to(contact.gap);
    if (words.field == "contact.length") words.apply_to(contact.length);
    if (names(words, "contact.normal")) change_vector(words, contact.normal);
    if (names(words, "contact.impulse")) change_vector(words, contact.impulse);
    motion.contacts.emplace({contact});
    if (words.verb == "contact") motion.contacts->push_back(contact);
}

Quaternion turned(const Quaternion& q, double angle) {
    const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle);
    return {c * q[0] - s * q[3], 0.0, 0.0, c * q[3] + s * q[0]};
}

/// `before`: the state at the start of the window.
void change(const Words& words, const Motion& before, Motion& motion) {
    GrainState& first = motion.grains[0];
    if (words.field.rfind("report.", 0) == 0) return change_field(words, motion.report);
    if (words.field.rfind("contact.", 0) == 0 || words.verb == "contact")
        return add_contact(words, motion);
    if (words.verb == "turn") {
        first.orientation = turned(first.orientation, words.value);
    } else if (words.verb == "part") {
        for (std::size_t i = 0; i < 3; ++i)
            first.position[i] = before.grains[0].position[i] +
                                words.value * (first.position[i] - before.grains[0].position[i]);
    } else if (words.verb == "turned") {
        first.orientation =
            turned(before.grains[0].orientation, words.value * 0.01 * first.angular_velocity[2]);
    } else if (words.verb == "drop" || words.verb == "leave") {
        motion.grains.erase(motion.grains.begin());
        motion.report.removed = words.verb == "leave" ? 1 : 0;
    } else if (words.verb == "twice") {
        motion.grains.push_back(first);
    } else if (words.verb == "swap") {
        std::swap(first.id, motion.grains[1].id);
    } else {
        change_field(words, first);
    }
}

void change(const Words& words, Hello& hello) {
    if (words.field == "hello.dimension") return words.apply_to(hello.dimension);
    if (words.field == "hello.protocol_major") return words.apply_to(hello.protocol_major);
    if (words.field == "hello.protocol_minor") return words.apply_to(hello.protocol_minor);
    if (words.field == "hello.ranks") return words.apply_to(hello.ranks);
    if (words.field == "hello.case_hash") return void(hello.case_hash = "0");
    throw std::logic_error("no field " + words.field);
}

/// Six numbers of eight bytes: magic, kind, window, iteration, sequence, length of the payload.
void change_frame(const Words& words, Bytes& frame) {
    const std::vector<std::string> fields = {"magic", "kind", "window", "iteration", "sequence"};
    const auto at = std::find(fields.begin(), fields.end(), words.field.substr(6)) - fields.begin();
    std::int64_t number = 0;
    std::memcpy(&number, &frame.at(8 * static_cast<std::size_t>(at)), 8);
    words.apply_to(number);
    std::memcpy(&frame.at(8 * static_cast<std::size_t>(at)), &number, 8);
}

bool is_due(const Envelope& at, const std::string& message) {
    if (message == "hello") return at.kind == Kind::hello;
    if (message == "motion") return at.kind == Kind::motion && at.window == 3;
    return at.kind == Kind::state && at.window == (message == "start" ? -1 : 3);
}

Bytes changed(const Words& words, const Motion& before, Message message) {
    if (words.verb == "cut" || words.verb == "extend") {
        const double sign = words.verb == "cut" ? -1.0 : 1.0;
        message.payload.resize(message.payload.size() +
                               static_cast<std::size_t>(sign * words.value));
        return frame(message);
    }
    if (message.envelope.kind == Kind::hello) {
        Hello hello = decode<Hello>(message.payload);
        change(words, hello);
        return frame({message.envelope, encode(hello)});
    }
    Motion motion = decode<Motion>(message.payload);
    change(words, before, motion);
    return frame({message.envelope, encode(motion)});
}

class FaultTable : public testing::TestWithParam<FaultLine> {
 protected:
    /// Changes the message of the fault, once.
    LoopbackChannel::Hook fault(const FaultLine& line) {
        return [this, line, words = Words(line.change)](Bytes& bytes) {
            const Message message = unframe(bytes);
            if (is_due(message.envelope, line.message)) {
                played_ = true;
                if (words.field.rfind("frame.", 0) == 0)
                    change_frame(words, bytes);
                else
                    bytes = changed(words, before_, message);
            }
            if (message.envelope.kind == Kind::state) before_ = decode<Motion>(message.payload);
            return true;
        };
    }

    /// Three discs that fall and spin.
    static Job honest_job() {
        Job job;
        for (GrainState& grain : job.population) {
            grain.velocity = {0.3, -0.2, 0.0};
            grain.angular_velocity = {0.0, 0.0, 0.7};
        }
        return job;
    }

    bool played_ = false;
    Motion before_;
};

TEST_P(FaultTable, EndsTheRunInWords) {
    const TestFolder folder("fault-" + GetParam().name);
    Job job = honest_job();
    job.from_grains = fault(GetParam());
    job.run(folder);
    EXPECT_TRUE(played_) << "the message never came";
    EXPECT_EQ(static_cast<int>(job.status.code), GetParam().code) << job.status.reason;
    for (const std::string& part : GetParam().says)
        EXPECT_NE(job.status.reason.find(part), std::string::npos) << part << "\nnot in\n"
                                                                   << job.status.reason;
    EXPECT_NE(job.status.reason.find("grains"), std::string::npos) << job.status.reason;
    EXPECT_LE(job.status.statistics.windows_done, 3);
}

TEST_F(FaultTable, TheSameJobIsDoneWithoutAFault) {
    const TestFolder folder("no-fault");
    Job job = honest_job();
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_LT(job.status.statistics.maxima.motion_defect, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(AllOf, FaultTable, testing::ValuesIn(fault_table()),
                         [](const auto& info) { return test_name(info.param); });

}  // namespace
}  // namespace turbidite
