// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a program of the job says of itself: exit codes that are not its to give, texts that are not
// UTF-8 or would control a terminal. Error, code and record survive all of them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

class Received : public testing::Test {
 protected:
    Job job;
    const TestFolder folder{std::string("received-") +
                            testing::UnitTest::GetInstance()->current_test_info()->name()};

    /// The grains give up in window 3.
    void fail_with(int code, const std::string& text) {
        job.grains_fault = [=](const std::string& function, std::int64_t window) {
            if (function == "advance" && window == 3)
                throw Failure(static_cast<ExitCode>(code), text);
        };
        job.run(folder);
    }

    nlohmann::json record() const {
        return nlohmann::json::parse(std::ifstream(folder.files().record));
    }
};

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

class ReceivedCode : public Received, public testing::WithParamInterface<int> {};

TEST_P(ReceivedCode, ThatIsNoProgramsIsAFailedParticipant) {
    fail_with(GetParam(), "lost");
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_TRUE(says(job.status.reason, "lost")) << job.status.reason;
    EXPECT_TRUE(says(job.status.reason, std::to_string(GetParam()))) << job.status.reason;
    EXPECT_EQ(record().at("status"), "failed");
    EXPECT_EQ(record().at("exit_code"), 4);
    EXPECT_EQ(record().at("windows_done"), 3);
    for (const Outcome& outcome : job.outcomes)
        EXPECT_EQ(outcome.code, ExitCode::participant_failed);
}

// What a program finds wrong with its input within a job is no impossible code.
TEST_F(Received, BadInputIsAFailedParticipantWithoutARemark) {
    fail_with(static_cast<int>(ExitCode::bad_input), "lost");
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_TRUE(says(job.status.reason, "lost")) << job.status.reason;
    EXPECT_FALSE(says(job.status.reason, "no program of a job may give")) << job.status.reason;
}

INSTANTIATE_TEST_SUITE_P(Codes, ReceivedCode,
                         testing::Values(0, 1, 7, 77, 130, 143, 256, -1, 1 << 30),
                         [](const auto& info) {
                             return info.param < 0 ? "Negative" : std::to_string(info.param);
                         });

TEST_F(Received, CodesOfTheTableStay) {
    for (const int code : {3, 4, 5, 6}) {
        job = Job();
        fail_with(code, "lost");
        EXPECT_EQ(static_cast<int>(job.status.code), code) << job.status.reason;
    }
}

TEST_F(Received, ATextThatIsNotUtf8IsMended) {
    fail_with(4, "r\xe9gime \x1b[31mperdu\x1b[0m\x07\nsecond line");
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_TRUE(says(job.status.reason, "r\ufffdgime \ufffd[31mperdu\ufffd[0m\ufffd\nsecond line"))
        << job.status.reason;
    EXPECT_EQ(record().at("exit_code"), 4);
    EXPECT_EQ(record().at("error"), job.status.reason);
    std::ifstream log(folder.files().log);
    const std::string text{std::istreambuf_iterator<char>(log), {}};
    EXPECT_TRUE(says(text, "perdu"));
    EXPECT_FALSE(says(text, "\x1b"));
}

TEST_F(Received, WhatIsUtf8StaysAsItIs) {
    fail_with(4, "Größe µ → ∞\t𝛺");
    EXPECT_TRUE(says(job.status.reason, "Größe µ → ∞\t𝛺")) << job.status.reason;
}

TEST_F(Received, NamesThatAreNotUtf8AreMended) {
    job.from_grains = [](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::hello) return true;
        Hello hello = decode<Hello>(message.payload);
        hello.adapter = "scripted";
        hello.adapter_version =
            "1\xc2\x9b"
            "31m";  // the one-letter form of ESC [
        hello.host_code = "Code \xe9\n\x1b]0;title";
        hello.host = "h\xff";
        bytes = frame({message.envelope, encode(hello)});
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const nlohmann::json grains = record().at("ranks").back();
    EXPECT_EQ(grains.at("adapter_version"), "1\ufffd31m");
    EXPECT_EQ(grains.at("host_code"), "Code \ufffd \ufffd]0;title");
    EXPECT_EQ(grains.at("host"), "h\ufffd");
}

TEST_F(Received, ANameThatTheCaseRefusesIsMendedInTheRefusal) {
    job.adapter = "m\xe9ine\x1b[2J";
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::handshake_refused);
    EXPECT_TRUE(says(job.status.reason, "adapter is m\ufffdine\ufffd[2J")) << job.status.reason;
    EXPECT_EQ(record().at("exit_code"), 3);
}

TEST_F(Received, AFaultOfACheckpointIsMended) {
    job.settings.set("checkpoint.windows", std::int64_t{2});
    job.from_grains = [](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::saved) return true;
        SavedPart part = decode<SavedPart>(message.payload);
        part.fault = "plein \xe0 craquer \x1b[5m";
        bytes = frame({message.envelope, encode(part)});
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    std::ifstream log(folder.files().log);
    const std::string text{std::istreambuf_iterator<char>(log), {}};
    EXPECT_TRUE(says(text, "plein \ufffd craquer \ufffd[5m")) << text;
    EXPECT_FALSE(says(text, "\x1b"));
}

/// Gives up in its third window with the code of success.
class EndsEarly final : public Scheme {
 public:
    explicit EndsEarly(std::unique_ptr<Scheme> of) : of_(std::move(of)) {}
    WindowResult play(const Window& window, const Motion& before, SchemeContext context) override {
        if (window.index == 2) throw Failure(ExitCode::done, "enough");
        return of_->play(window, before, context);
    }

 private:
    std::unique_ptr<Scheme> of_;
};

TEST_F(Received, DoneMeansThatAllWindowsAreDone) {
    SchemeEntry entry = find_scheme("split");
    entry.make = [](const Settings& settings) -> std::unique_ptr<Scheme> {
        return std::make_unique<EndsEarly>(find_scheme("split").make(settings));
    };
    job.scheme = entry;
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_TRUE(says(job.status.reason, "enough")) << job.status.reason;
    EXPECT_TRUE(says(job.status.reason, "2 of ")) << job.status.reason;
    EXPECT_EQ(record().at("status"), "failed");
}

}  // namespace
}  // namespace turbidite
