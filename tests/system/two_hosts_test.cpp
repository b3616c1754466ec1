// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A job on two hosts: two network namespaces of this machine, joined by a cable (veth), each with a
// host name of its own, so that programs of one do not share memory with those of the other. Needs
// root and `ip`; elsewhere these tests are skipped.
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class TwoHosts : public ShellTest {
 protected:
    void SetUp() override {
        const std::string setup =
            "ip netns add " + a_ + " && ip netns add " + b_ + " && ip link add " + cable_ +
            "a type veth peer name " + cable_ + "b && ip link set " + cable_ + "a netns " + a_ +
            " && ip link set " + cable_ + "b netns " + b_ + " && ip -n " + a_ +
            " addr add 10.77.0.1/24 dev " + cable_ + "a && ip -n " + b_ +
            " addr add 10.77.0.2/24 dev " + cable_ + "b && for n in a b; do ip -n " + name_ +
            "$n link set lo up && ip -n " + name_ + "$n link set " + cable_ + "$n up; done";
        const Answer answer = shell(setup);
        if (answer.code != 0) GTEST_SKIP() << "no network namespaces here: " << answer.err;
        scratch.write("hosts", "10.77.0.1 slots=8\n10.77.0.2 slots=8\n");
        // mpirun starts its daemon on the other host as: AGENT HOST COMMAND.
        scratch.write("agent", "#!/bin/sh\nshift\nexec ip netns exec " + b_ +
                                   " unshare --uts sh -c \"hostname host-b; $*\"\n");
        shell("chmod +x agent");
    }

    void TearDown() override { shell("ip netns del " + a_ + "; ip netns del " + b_); }

    /// On host a, from where mpirun goes to host b as well.
    std::string from_host_a(const std::string& command) const {
        const std::string here = scratch.path();
        scratch.write(
            "on-a",
            "#!/bin/sh\nhostname host-a\n"
            "export OMPI_MCA_plm_rsh_agent=" +
                here +
                "/agent "
                "OMPI_MCA_orte_default_hostfile=" +
                here +
                "/hosts "
                "OMPI_MCA_oob_tcp_if_include=10.77.0.0/24 OMPI_MCA_btl_tcp_if_include=10.77.0.0/24 "
                "OMPI_MCA_rmaps_base_mapping_policy=node\n"
                "exec timeout 300 " TURBIDITE_PROGRAM " " +
                command + "\n");
        return "ip netns exec " + a_ + " unshare --uts sh ./on-a";
    }

    /// Hosts of the ranks of a role, in their order.
    std::vector<std::string> hosts(const std::string& run, const std::string& role) const {
        std::vector<std::string> found;
        const auto record = nlohmann::json::parse(text(scratch.path() / run / "run.json"));
        for (const auto& rank : record.at("ranks"))
            if (rank.at("role") == role) found.push_back(rank.at("host"));
        return found;
    }

    const std::string name_ = "turbidite-" + std::to_string(::getpid()) + "-", a_ = name_ + "a",
                      b_ = name_ + "b", cable_ = "tb" + std::to_string(::getpid());
};

const char* const spheres =
    "dimension: 3\n"
    "domain: {size: [8, 6, 6]}\n"
    "grains: {adapter: standalone-nscd, generator: random, count: 110}\n"
    "fluid: {enabled: false}\n"
    "contact: {friction: 0.3}\n"
    "time: {step: 0.01, end: 4}\n"
    "output: {interval: 1}\n";

TEST_F(TwoHosts, GrainsOnBothHaveTheDigitsOfOneRank) {
    scratch.write("case.yaml", spheres);
    ASSERT_EQ(shell(TURBIDITE_PROGRAM " run case.yaml --out one").code, 0);
    const Answer answer = shell(from_host_a("run case.yaml --out two --set grains.ranks=2"));
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    const std::vector<std::string> where = hosts("two", "grains");
    ASSERT_EQ(where.size(), 2u);
    EXPECT_NE(where[0], where[1]);
    const std::string history = text(scratch.path() / "one/history.csv");
    ASSERT_GT(columns_of(history).at("contacts").back(), 100.0);
    EXPECT_EQ(lines_without_wall_times(history),
              lines_without_wall_times(text(scratch.path() / "two/history.csv")));
    for (const char* series : {"grains", "contacts"}) {
        const std::string file = std::string("/grains/") + series + "_00000400.vtp";
        const std::string of_one = text(scratch.path() / ("one" + file));
        EXPECT_GT(of_one.size(), 1000u);
        EXPECT_EQ(of_one, text(scratch.path() / ("two" + file))) << series;
    }
}

TEST_F(TwoHosts, ALiquidOnBothIsThatOfOneHost) {
    const std::string run =
        "run quickstart --set time.end=2 --set output.interval=1 --set fluid.ranks=2 "
        "--set grains.adapter=standalone-nscd --out ";
    ASSERT_EQ(shell(TURBIDITE_PROGRAM " " + run + "one").code, 0);
    const Answer answer = shell(from_host_a(run + "two"));
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    const std::vector<std::string> where = hosts("two", "fluid");
    ASSERT_EQ(where.size(), 2u);
    EXPECT_NE(where[0], where[1]);
    const auto one = columns_of(text(scratch.path() / "one/history.csv")),
               two = columns_of(text(scratch.path() / "two/history.csv"));
    EXPECT_LT(one.at("mean_velocity_y").back(), -0.05);
    for (const char* name : {"mean_velocity_y", "mean_position_y", "mean_speed"})
        EXPECT_NEAR(one.at(name).back(), two.at(name).back(), 1e-7) << name;
}

TEST_F(TwoHosts, ACutCableEndsTheRunInWords) {
    scratch.write("case.yaml", spheres);
    const pid_t job =
        begin(from_host_a("run case.yaml --out cut --set grains.ranks=2 --set time.end=4000 "
                          "--set limits.stall_soft=2 --set limits.stall_hard=6"));
    const std::filesystem::path history = scratch.path() / "cut/history.csv";
    for (int tenth = 0; tenth < 600 && text(history).size() < 2000; ++tenth)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ASSERT_GE(text(history).size(), 2000u) << "it has to run first";
    shell("ip -n " + a_ + " link set " + cable_ + "a down");
    const Answer answer = end_of(job);
    EXPECT_TRUE(answer.code == 4 || answer.code == 5) << answer.code << answer.err;
    EXPECT_SAYS(text(scratch.path() / "cut/run.json"), "grains rank 0");
}

}  // namespace
}  // namespace turbidite
