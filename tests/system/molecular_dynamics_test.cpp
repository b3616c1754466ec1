// SPDX-License-Identifier: GPL-3.0-or-later
//
// grains.adapter: yade-md as seen by the user, compared with yade-nscd where both must agree.
#include <algorithm>
#include <cmath>

#include "tests/system/history_columns.hpp"
#include "tests/system/program.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

class MolecularDynamics : public ShellTest {
 protected:
    /// Runs the case and returns its history.
    Columns play(const std::string& name, const std::string& options) const {
        const fs::path out = scratch.path() / name;
        const Answer answer = shell(program + " run " + (scratch.path() / "case.yaml").string() +
                                    " --out " + out.string() + options);
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        maxima = nlohmann::json::parse(text(out / "run.json")).at("maxima");
        return columns_of(text(out / "history.csv"));
    }

    Answer check(const std::string& options) const {
        return shell(program + " check " + (scratch.path() / "case.yaml").string() + options);
    }

    /// A closed box of liquid with the grains of a CSV file.
    void wet(const std::string& size, const std::string& grains, const std::string& end) {
        scratch.write("grains.csv", "id,x,y\n" + grains);
        scratch.write("case.yaml", "domain:\n  size: " + size +
                                       "\ngrains:\n  adapter: yade-md\n  file: grains.csv\n"
                                       "fluid:\n  reynolds: 36\n  cells_per_diameter: 8\n"
                                       "  multiplier_tolerance: 1e-9\n"
                                       "coupling:\n  scheme: split\n"
                                       "time:\n  step: 0.0125\n  end: " +
                                       end + "\noutput:\n  interval: 0.05\n");
    }

    mutable nlohmann::json maxima;
};

TEST_F(MolecularDynamics, ChecksItsKeys) {
    wet("[4, 4]", "1,2,2\n", "0.1");
    const Answer good = check("");
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_SAYS(good.out, "sub-steps per window");
    const Answer joint = check(" --set coupling.scheme=joint");
    EXPECT_EQ(joint.code, 2);
    EXPECT_SAYS(joint.err, "coupling.scheme = joint");
    EXPECT_SAYS(joint.err, "yade-md");
    const Answer cyclic = check(" --set domain.left=cyclic --set domain.right=cyclic");
    EXPECT_EQ(cyclic.code, 2);
    EXPECT_SAYS(cyclic.err, "yade-md does not support cyclic sides");
    const Answer coarse = check(" --set contact.md_substeps=5");
    EXPECT_EQ(coarse.code, 2);
    EXPECT_SAYS(coarse.err, "contact.md_substeps = 5");
    const Answer idle = check(" --set contact.tolerance=1e-5 --set coupling.positions=contact");
    EXPECT_EQ(idle.code, 0) << idle.err;
    EXPECT_SAYS(idle.out,
                "contact.tolerance, coupling.positions have no effect with "
                "grains.adapter: yade-md");
    const Answer other = check(" --set grains.adapter=yade-nscd --set contact.md_stiffness=1e5");
    EXPECT_SAYS(other.out, "contact.md_stiffness has no effect with grains.adapter: yade-nscd");
}

// A heap of discs: windows are repeated until contacts and fluid agree, which `split` leaves apart.
TEST_F(MolecularDynamics, RepeatsWindowsUntilContactsAndFluidAgree) {
    wet("[4, 6]", "1,1,0.6\n2,2.1,0.6\n3,1.6,1.6\n4,2.9,1.7\n5,2.2,2.7\n", "3");
    for (const std::string adapter : {"lammps-md", "yade-md", "standalone-md"}) {
        const std::string host = " --set grains.adapter=" + adapter;
        const Columns split = play(adapter + "-split", host);
        const Columns run = play(adapter, host + " --set coupling.scheme=sub-iterated");
        EXPECT_LT(maxima.at("grain_balance").get<double>(), 1e-10) << adapter;
        double rounds = 0.0, contacts = 0.0, apart = 0.0;
        std::vector<double> mismatch;
        for (std::size_t k = 1; k < run.at("time").size(); ++k) {
            rounds = std::max(rounds, run.at("joint_rounds")[k]);
            contacts = std::max(contacts, run.at("contacts")[k]);
            mismatch.push_back(run.at("joint_mismatch")[k]);
            apart = std::max(
                apart, std::abs(run.at("mean_velocity_y")[k] - split.at("mean_velocity_y")[k]));
        }
        std::sort(mismatch.begin(), mismatch.end());
        EXPECT_GE(contacts, 3.0) << adapter;
        EXPECT_GT(rounds, 2.0) << adapter;
        EXPECT_LT(mismatch[mismatch.size() * 9 / 10], 1e-4) << adapter;  // coupling.tolerance
        EXPECT_GT(apart, 1e-4) << adapter;
        EXPECT_LT(apart, 0.05) << adapter;
    }
}

// k = S m g/D: the contact time of two grains is pi sqrt(D/(2 S g)) = 0.00702 t_c for S = 1e5, so a
// window of 0.0125 t_c takes 35.6 sub-steps of a twentieth.
TEST_F(MolecularDynamics, StepsAsItsStiffnessAsks) {
    wet("[4, 4]", "1,2,2\n", "0.1");
    EXPECT_SAYS(check(" --set contact.md_stiffness=1e5").out,
                "contact time 0.00702 t_c, 36 sub-steps per window");
}

// Without contacts both adapters move a grain alike, whether or not the last hydrodynamic impulse
// is held over the sub-steps: an announced impulse is not counted twice.
TEST_F(MolecularDynamics, ASettlingDiscMovesAsUnderContactDynamics) {
    wet("[4, 5]", "1,2.03,3.4\n", "0.6");
    const Columns nscd = play("nscd", " --set grains.adapter=yade-nscd");
    EXPECT_LT(nscd.at("mean_velocity_y").back(), -0.05);  // it falls
    for (const std::string how :
         {"yade-md --set coupling.md_hold=true", "yade-md --set coupling.md_hold=false",
          "lammps-md --set coupling.md_hold=true", "lammps-md --set coupling.md_hold=false",
          "standalone-md --set coupling.md_hold=true"}) {
        const Columns md = play("md", " --force --set grains.adapter=" + how);
        for (const char* name :
             {"mean_velocity_x", "mean_velocity_y", "mean_position_x", "mean_position_y"})
            EXPECT_LT(largest_difference(md.at(name), nscd.at(name)), 1e-7) << name << how;
        EXPECT_LT(maxima.at("grain_balance"), 1e-10);
        EXPECT_LT(maxima.at("fluid_balance"), 1e-6);
        EXPECT_TRUE(std::isnan(md.at("contact_residual").back()));
        EXPECT_GT(md.at("contact_iterations").back(), 1.0);
    }
}

// Discs turn as well, from the angle that the case gives: the fluid's points turn with them.
TEST_F(MolecularDynamics, ASpinningDiscBeginsAtItsAngleInEveryHost) {
    wet("[4, 5]", "", "0.1");
    scratch.write("grains.csv", "id,x,y,angle,spin\n1,2.03,3.4,0.4,2\n");
    for (const std::string adapter : {"yade-md", "lammps-md", "standalone-md"}) {
        play("md", " --force --set grains.adapter=" + adapter);
        EXPECT_LT(maxima.at("motion_defect"), 1e-12) << adapter;
    }
}

// Three discs above each other at rest: they compress their springs and stay, and their forces
// balance in every window with output, in which YADE's forces are summed body by body.
// An inflow is a wall for the grains.
TEST_F(MolecularDynamics, ADiscComesToRestOnAnInflow) {
    wet("[4, 4]", "1,2,0.6\n", "3");
    const Columns run = play("inflow",
                             " --set domain.bottom=inflow --set domain.bottom_motion=stream"
                             " --set domain.top=free --set domain.motions.stream.kind=constant"
                             " --set domain.motions.stream.velocity=[0,0.001]");
    EXPECT_NEAR(run.at("mean_position_y").back(), 0.5, 0.01);
    EXPECT_LT(run.at("mean_speed").back(), 0.01);
    EXPECT_GT(run.at("contacts").back(), 0.0);
}

TEST_F(MolecularDynamics, ABedAtRestIsQuietAndBalanced) {
    wet("[4, 5]", "1,2,0.5\n2,2,1.5\n3,2,2.5\n", "1");
    for (const std::string adapter : {"yade-md", "lammps-md", "standalone-md"}) {
        const Columns md = play(adapter, " --set grains.adapter=" + adapter);
        EXPECT_EQ(md.at("contacts").back(), 3.0);
        EXPECT_LT(md.at("mean_speed").back(), 1e-5);
        EXPECT_LT(largest(md.at("max_penetration")), 1e-3);
        EXPECT_GT(largest(md.at("max_penetration")), 0.0);
        EXPECT_LT(maxima.at("grain_balance"), 1e-10);
        EXPECT_LT(maxima.at("fluid_balance"), 1e-6);
    }
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

class DryColumn : public MolecularDynamics {
 protected:
    void SetUp() override;

    Columns play_with(const std::string& adapter, const std::string& options = "") const {
        return play("run", " --force --set grains.adapter=" + adapter + options);
    }
};

void DryColumn::SetUp() {
    std::string grains = "id,x,y\n";
    for (int row = 0, id = 0; row < 8; ++row)
        for (int k = 0; k < 5; ++k, ++id)
            grains += std::to_string(id) + "," + std::to_string(0.501 + 1.2 * k + 0.6 * (row % 2)) +
                      "," + std::to_string(0.501 + 0.802 * row) + "\n";
    scratch.write("grains.csv", grains);
    scratch.write("case.yaml",
                  "domain:\n  size: [40, 10]\n  right: free\n  top: free\n"
                  "grains:\n  adapter: yade-md\n  file: grains.csv\n"
                  "fluid:\n  enabled: false\n"
                  "time:\n  step: 0.01\n  end: 4\noutput:\n  interval: 0.1\n");
}

/// The first entries of a column.
std::vector<double> beginning(const Columns& columns, const std::string& name, std::size_t count) {
    std::vector<double> values = columns.at(name);
    values.resize(count);
    return values;
}

// A small column without fluid collapses with all adapters: equally until grains have collided for
// a while; after that only in the mean, since the motion is chaotic.
TEST_F(DryColumn, CollapsesAsUnderContactDynamics) {
    const Columns nscd = play_with("yade-nscd");
    const std::vector<double> rigid = nscd.at("mean_velocity_norm");
    EXPECT_GT(largest(rigid), 0.5);
    for (const char* adapter : {"yade-md", "lammps-md", "standalone-md"}) {
        SCOPED_TRACE(adapter);
        const Columns md = play_with(adapter);
        const double overlap = maxima.at("penetration");
        EXPECT_GT(overlap, 0.0);
        EXPECT_LT(overlap, 1e-3);
        EXPECT_NEAR(mean(md.at("mean_velocity_norm")), mean(rigid), 0.1 * mean(rigid));
        const auto to_1_6 = [](const Columns& run) {
            return beginning(run, "mean_velocity_norm", 17);
        };
        EXPECT_LT(largest_difference(to_1_6(md), to_1_6(nscd)), 0.05 * largest(rigid));
        EXPECT_NEAR(md.at("front_x").back(), nscd.at("front_x").back(), 0.5);
    }
}

// Springs and dashpots are the same; friction is not quite (docs/md.md).
TEST_F(DryColumn, IsTheSameInAllCodesWithoutFriction) {
    const std::string options = " --set contact.friction=0 --set time.end=1";
    const Columns yade = play_with("yade-md", options);
    EXPECT_GT(largest(yade.at("mean_speed")), 0.3);
    for (const char* adapter : {"lammps-md", "standalone-md"}) {
        const Columns other = play_with(adapter, options);
        for (const char* name : {"mean_velocity_norm", "mean_speed", "mean_position_x"})
            EXPECT_LT(largest_difference(yade.at(name), other.at(name)), 1e-4) << name << adapter;
    }
}

// Both limit spring and dashpot together; one is leap-frog, the other velocity Verlet.
TEST_F(DryColumn, HasTheFrictionOfLammpsWithoutAHostCode) {
    const std::string options = " --set time.end=1";
    const Columns lammps = play_with("lammps-md", options);
    const Columns own = play_with("standalone-md", options);
    EXPECT_GT(largest(lammps.at("mean_speed")), 0.2);
    for (const char* name : {"mean_velocity_norm", "mean_speed", "mean_position_x"})
        EXPECT_LT(largest_difference(lammps.at(name), own.at(name)), 2e-3) << name;
}

// Rounding, which grows with the collisions.
TEST_F(DryColumn, IsTheSameInLammpsOnOneRankAndOnTwo) {
    const std::string options = " --set output.interval=0.02 --set time.end=0.4";
    const Columns one = play_with("lammps-md", options);
    const Columns two = play_with("lammps-md", options + " --set grains.ranks=2");
    EXPECT_GT(one.at("contacts").back(), 40.0);
    EXPECT_EQ(one.at("contacts").back(), two.at("contacts").back());
    for (const char* name : {"mean_velocity_norm", "mean_speed", "mean_position_x"})
        EXPECT_LT(largest_difference(one.at(name), two.at(name)), 1e-8) << name;
}

}  // namespace
}  // namespace turbidite
