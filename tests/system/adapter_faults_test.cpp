// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Faults of tests/faults/faults.txt played by a program of its own, in Python, beside the shipped
// fluid: a handful, one per kind of message, or all of them with TURBIDITE_ALL_FAULTS=1 in the
// environment. tests/unit/coupler/fault_table_test.cpp plays all of them always, in one process.
#include "tests/faults/fault_table.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const std::vector<std::string> always = {
    "spinning-at-the-start", "held-in-the-contacts", "does-not-turn",    "moves-half",
    "leaves-through-a-wall", "contact-twice",        "another-dimension"};

std::vector<FaultLine> chosen_faults() {
    const char* all = std::getenv("TURBIDITE_ALL_FAULTS");
    std::vector<FaultLine> chosen;
    for (const FaultLine& fault : fault_table())
        if ((all && std::string(all) == "1") ||
            std::find(always.begin(), always.end(), fault.name) != always.end())
            chosen.push_back(fault);
    return chosen;
}

class AdapterFaults : public ShellTest, public ::testing::WithParamInterface<FaultLine> {
 protected:
    void SetUp() override {
        with_python_of_tests();
        scratch.write("grains.csv",
                      "id,x,y,vx,vy,spin\n"
                      "3,2,5,0.3,-0.2,0.7\n4,4,5,0,0,0.5\n9,6,5,-0.3,0.1,-0.7\n");
        scratch.write("fall.yaml",
                      "domain: {size: [8, 8]}\n"
                      "grains: {adapter: external, command: none, file: grains.csv}\n"
                      "fluid: {reynolds: 30, cells_per_diameter: 6}\n"
                      "coupling: {scheme: split}\n"
                      "time: {step: 0.01, end: 0.06}\n"
                      "output: {interval: 0.01}\n"
                      "limits: {stall_soft: 5, stall_hard: 20}\n");
    }

    Answer run(const std::string& fault) const {
        const std::string folder = FAULTS_FOLDER;
        return shell("timeout 60 " TURBIDITE_PROGRAM
                     " run fall.yaml --out run --force --set "
                     "'grains.command=/usr/bin/python3 " +
                     folder + "/faulty_grains.py " + folder + "/faults.txt " + fault + "'");
    }
};

TEST_P(AdapterFaults, EndTheRunInWords) {
    const Answer answer = run(GetParam().name);
    EXPECT_EQ(answer.code, GetParam().code) << answer.out << answer.err;
    EXPECT_SAYS(text(run_folder() / "logs/grains.log"), "fault: ");
    EXPECT_EQ(answer.out.find("Done"), std::string::npos) << answer.out;
    for (const std::string& part : GetParam().says) EXPECT_SAYS(answer.err, part);
}

TEST_F(AdapterFaults, TheSameProgramIsDoneWithoutAFault) {
    const Answer answer = run("none");
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_LT(record().at("maxima").at("motion_defect").get<double>(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Played, AdapterFaults, ::testing::ValuesIn(chosen_faults()),
                         [](const auto& info) { return test_name(info.param); });

}  // namespace
}  // namespace turbidite
