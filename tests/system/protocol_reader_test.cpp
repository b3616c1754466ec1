// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The same adapter over the library's C interface and over tests/python/wire_adapter.py, which
// knows the protocol from docs/protocol.md: they say the same, to the last digit.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

/// Falls, and reports whatever a report can have; ADAPTER in the environment names the module.
const char* const talkative = R"(import os, sys, numpy
library = __import__(os.environ['ADAPTER'])
from falling import Falling

class Talkative(Falling):
    def advance(self, window, responses):
        motion = super().advance(window, responses)
        motion.contacts, motion.iterations, motion.residual = 1, 7, 1e-3 / 7
        motion.quad, motion.max = 1e-4 / 3, 1e-5 / 3
        return motion
    def apply_kick(self, window, kicks):
        motion = super().apply_kick(window, kicks)
        motion.contacts, motion.max_penetration, motion.contact_violation = 2, 1e-3 / 3, 1e-6 / 7
        if window.write_output: motion.single_contacts = self.pair()
        return motion
    def pair(self):
        two = numpy.zeros(2, library.CONTACT)
        a, b = sorted(self.grains[:2], key=lambda grain: grain['id'])
        two['a'], two['b'], two['wall'], two['feature'], two['status'] = a['id'], b['id'], -1, (0, 1), (1, 2)
        two['branch'] = b['position'] - a['position']
        far = numpy.linalg.norm(two['branch'][0])
        two['normal'], two['gap'], two['length'] = two['branch'] / far, far - 1, 1 / 3
        two['point'], two['impulse'], two['rolling_impulse'] = a['position'] + 1 / 7, 1 / 9, (0, 0, 1 / 11)
        return two

library.run_grains(Talkative(library), sys.argv[-1])
)";

class ProtocolReader : public ShellTest, public ::testing::WithParamInterface<const char*> {
 protected:
    void SetUp() override {
        with_python_of_tests();
        scratch.write("talkative.py", talkative);
        scratch.write("fall.yaml",
                      "domain: {size: [8, 8]}\n"
                      "grains: {adapter: external, command: /usr/bin/python3 talkative.py, count: "
                      "3}\n"
                      "fluid: {reynolds: 30, cells_per_diameter: 6}\n"
                      "coupling: {recording: grains}\n"
                      "time: {step: 0.01, end: 0.06}\n"
                      "output: {interval: 0.02}\n"
                      "limits: {stall_soft: 5, stall_hard: 20}\n");
    }

    Answer with(const std::string& adapter, const std::string& command) const {
        return shell("ADAPTER=" + adapter + " timeout 120 " TURBIDITE_PROGRAM " " + command);
    }
};

TEST_P(ProtocolReader, AndTheLibrarySayTheSame) {
    const std::string run =
        std::string("run fall.yaml --set coupling.scheme=") + GetParam() + " --out ";
    const Answer wire = with("wire_adapter", run + "wire");
    ASSERT_EQ(wire.code, 0) << wire.out << wire.err;
    const Answer library = with("turbidite_adapter", run + "library");
    ASSERT_EQ(library.code, 0) << library.out << library.err;
    EXPECT_EQ(lines_of_history("wire").size(), 5u);
    EXPECT_EQ(lines_of_history("wire"), lines_of_history("library"));

    const Answer replayed = with("turbidite_adapter", "replay wire --out again");
    EXPECT_EQ(replayed.code, 0) << replayed.out << replayed.err;
    EXPECT_SAYS(replayed.out, "of the grains compared: identical");

    const std::string contacts = "/grains/contacts_00000006.vtp";
    const std::string told = text(scratch.path() / ("wire" + contacts));
    EXPECT_SAYS(told, "NumberOfLines=\"2\"");
    EXPECT_EQ(text(scratch.path() / ("library" + contacts)), told);
}

INSTANTIATE_TEST_SUITE_P(Schemes, ProtocolReader, ::testing::Values("split", "sub-iterated"),
                         [](const auto& info) {
                             return std::string(info.param) == "split" ? "Split" : "SubIterated";
                         });

}  // namespace
}  // namespace turbidite
