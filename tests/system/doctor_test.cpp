// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite doctor: all is well here; what is taken away is named, with the command that brings it
// back.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

constexpr auto names = {"OpenFOAM",
                        "YADE",
                        "LAMMPS",
                        "turbidite-lammps",
                        "Open MPI",
                        "numpy",
                        "matplotlib",
                        "mpi4py",
                        "turbidite-coupler",
                        "turbidite-fluid",
                        "turbidite-fluid-box",
                        "turbidite-grains",
                        "turbidite-grains-md",
                        "libturbidite.so",
                        "turbidite_adapter.py",
                        "turbidite_yade.so",
                        "one libmpi",
                        "free disk",
                        "free memory",
                        "mpirun may run"};

class Doctor : public ShellTest {
 protected:
    const fs::path build = fs::path(TURBIDITE_PROGRAM).parent_path().parent_path();

    /// In a temporary folder of its own, to see what it leaves behind.
    Answer examine(const fs::path& program, const std::string& options) const {
        fs::create_directories(scratch.path() / "tmp");
        return shell("TMPDIR=" + (scratch.path() / "tmp").string() + " " + program.string() +
                     " doctor" + options);
    }

    /// The programs of the build, all but one, and its modules. The program itself is copied: it
    /// looks for the others beside itself.
    fs::path build_without(const std::string& missing) const {
        const fs::path bin = scratch.path() / "bin";
        fs::create_directories(bin);
        for (const char* name :
             {"turbidite-coupler", "turbidite-member", "turbidite-fluid", "turbidite-fluid-box",
              "turbidite-grains", "turbidite-grains-md", "turbidite-lammps"})
            if (name != missing) fs::create_symlink(build / "bin" / name, bin / name);
        fs::create_directory_symlink(build / "lib", scratch.path() / "lib");
        fs::copy_file(TURBIDITE_PROGRAM, bin / "turbidite");
        return bin / "turbidite";
    }
};

TEST_F(Doctor, SaysThatAllIsWellAndPlaysAJob) {
    const Answer answer = examine(TURBIDITE_PROGRAM, "");
    for (const std::string name : names) {
        const bool well = name != "free disk" || disk_has_room();
        EXPECT_SAYS(answer.out, (well ? "ok      " : "wrong   ") + name);
    }
    EXPECT_SAYS(answer.out, "\nok      coupled job                 6 grains, 20 windows");
    EXPECT_EQ(answer.code, healthy()) << answer.out << answer.err;
    EXPECT_EQ(answer.out.find("all is well\n") < std::string::npos, disk_has_room());
    EXPECT_TRUE(fs::is_empty(scratch.path() / "tmp")) << "the folder of the job is still there";
}

TEST_F(Doctor, PlaysNoJobIfNotWanted) {
    const Answer answer = examine(TURBIDITE_PROGRAM, " --no-job");
    EXPECT_EQ(answer.code, healthy()) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, std::string("\n-       coupled job                 --no-job\n") +
                                (disk_has_room() ? "all is well\n" : "Not all is well;"));
}

TEST_F(Doctor, NamesAMissingProgramAndItsRemedy) {
    const Answer answer = examine(build_without("turbidite-fluid"), "");
    EXPECT_EQ(answer.code, 2) << answer.out << answer.err;
    EXPECT_SAYS(answer.out,
                "\nmissing turbidite-fluid             not built\n"
                "        ./turbidite --version\n");
    EXPECT_SAYS(answer.out, "ok      turbidite-grains");
    EXPECT_SAYS(answer.out, "ok      CMake");  // to build it again
    EXPECT_SAYS(answer.out, "-       coupled job                 needs what is missing");
    EXPECT_SAYS(answer.out, "Exit code 2.");
}

TEST_F(Doctor, NamesAMissingPackageAndItsRemedy) {
    // A python3 that finds no matplotlib.
    scratch.write("hidden/matplotlib.py", "raise ModuleNotFoundError('matplotlib')\n");
    const Answer answer = shell("PYTHONPATH=" + (scratch.path() / "hidden").string() + " " +
                                TURBIDITE_PROGRAM + " doctor --no-job");
    EXPECT_EQ(answer.code, 2) << answer.out << answer.err;
    EXPECT_SAYS(answer.out,
                "missing matplotlib                  not installed\n"
                "        apt-get install --no-install-recommends python3-matplotlib\n");
}

TEST_F(Doctor, NamesAWrongVariable) {
    const Answer answer =
        shell(std::string("WM_PROJECT_DIR=/nowhere ") + TURBIDITE_PROGRAM + " doctor --no-job");
    EXPECT_EQ(answer.code, 2) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "wrong   OpenFOAM                    Could not find mandatory");
    EXPECT_SAYS(answer.out, "\n        unset WM_PROJECT_DIR\n");
}

TEST_F(Doctor, SaysThatTheJobFailed) {
    const fs::path program = build_without("turbidite-coupler");
    scratch.write("bin/turbidite-coupler", "#!/bin/sh\necho the coupler is not well >&2\nexit 9\n");
    fs::permissions(scratch.path() / "bin/turbidite-coupler", fs::perms::owner_all);
    const Answer answer = examine(program, "");
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.out,
                "\nwrong   coupled job                 coupler ended with status 9 before the run "
                "was over\n");
    EXPECT_SAYS(answer.out, "        ./turbidite run ");
    EXPECT_SAYS(answer.out, "The job failed. Exit code 4.");
    EXPECT_TRUE(fs::is_empty(scratch.path() / "tmp"));
}

TEST_F(Doctor, SeesTwoMpis) {
    const fs::path program = build_without("turbidite-grains");
    const std::string other = (scratch.path() / "other").string();
    const Answer built = shell(
        "mkdir other; cp $(ldd bin/turbidite-coupler | awk '/libmpi.so/ {print $3}') other; "
        "echo 'int MPI_Finalize(void); int main(void) { return MPI_Finalize(); }' | "
        "g++ -x c - -x none -o bin/turbidite-grains other/libmpi.so.* -Wl,-rpath," +
        other);
    ASSERT_EQ(built.code, 0) << built.err;
    const Answer answer = examine(program, " --no-job");
    EXPECT_EQ(answer.code, 2) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "\nwrong   one libmpi ");
    EXPECT_SAYS(answer.out, other + "/libmpi.so");
    EXPECT_SAYS(answer.out, "        rm -r build/release; ./turbidite --version\n");
}

}  // namespace
}  // namespace turbidite
