// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contacts of whole runs: three discs at rest, read from the files as a viewer reads them.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class ContactSeriesOfARun : public ShellTest, public ::testing::WithParamInterface<const char*> {
 protected:
    static constexpr auto still_case =
        "domain: {size: [6, 6]}\n"
        "grains: {file: still.csv, density_ratio: 1.5}\n"
        "fluid: {enabled: false}\n"
        "contact: {tolerance: 1e-8}\n"
        "time: {step: 0.01, end: 0.2}\n"
        "output: {interval: 0.1}\n";
    // A tower of two discs, and one beside it that touches neither the tower nor a wall.
    static constexpr auto still_grains = "id,x,y\n5,2,0.5\n6,2,1.5\n9,4,0.5\n";

    // Parses every file of the series; sums the forces on the floor (wall 2) at the last time.
    static constexpr auto read_back =
        "import xml.etree.ElementTree as E, pathlib\n"
        "folder = pathlib.Path('run/grains')\n"
        "for file in list(folder.glob('*.vtp')) + list(folder.glob('*.pvd')): E.parse(file)\n"
        "last = list(E.parse(folder / 'contacts.pvd').iter('DataSet'))[-1]\n"
        "cells = {a.get('Name'): a.text.split() for a in\n"
        "         E.parse(folder / last.get('file')).find('.//CellData')}\n"
        "floor = [(int(b), float(f)) for a, b, f in\n"
        "         zip(cells['id_a'], cells['id_b'], cells['normal_force']) if a == '-3']\n"
        "print(last.get('timestep'), len(cells['id_a']), *sorted(b for b, _ in floor))\n"
        "print(sum(f for _, f in floor))\n";
};

TEST_P(ContactSeriesOfARun, TheFloorCarriesTheWeight) {
    scratch.write("still.yaml", still_case);
    scratch.write("still.csv", still_grains);
    scratch.write("read.py", read_back);
    const Answer run = shell("timeout 120 " TURBIDITE_PROGRAM " run still.yaml" +
                             into_run_folder() + " --set grains.adapter=" + GetParam());
    ASSERT_EQ(run.code, 0) << run.out << run.err;
    const Answer read = shell("/usr/bin/python3 read.py");
    ASSERT_EQ(read.code, 0) << read.err;
    EXPECT_EQ(read.out.rfind("0.2 3 5 9\n", 0), 0u) << read.out;
    const double force = std::stod(read.out.substr(read.out.find('\n')));
    EXPECT_NEAR(force, 3 * 1.5 * 3.14159265358979 / 4.0, 1e-5);  // g = D = 1
    EXPECT_EQ(record().at("contact").at("unconverged_windows"), 0);
    EXPECT_SAYS(text(run_folder() / "logs/coupler.log"), "contacts 3");
}

INSTANTIATE_TEST_SUITE_P(Hosts, ContactSeriesOfARun,
                         ::testing::Values("standalone-nscd", "yade-nscd"), [](const auto& info) {
                             std::string name = info.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace turbidite
