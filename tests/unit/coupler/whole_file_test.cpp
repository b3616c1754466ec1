// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/whole_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "coupler/protocol/failure.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

class WholeFile : public ::testing::Test {
 protected:
    ScratchFolder folder;
    const fs::path file = folder.write("record.json", "old");

    std::string content() const {
        std::ifstream in(file);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    /// The error message of a failed write of "new".
    std::string complaint(const fs::path& to) const {
        try {
            write_whole(to, [](std::ostream& out) { out << "new"; });
        } catch (const Failure& failure) {
            return failure.what();
        }
        return "";
    }
};

TEST_F(WholeFile, IsReplacedAtOnce) {
    write_whole(file, [&](std::ostream& out) {
        out << "new" << std::flush;
        EXPECT_EQ(content(), "old") << "as long as it is being written";
    });
    EXPECT_EQ(content(), "new");
    EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

// The partial file is a link to /dev/full.
TEST_F(WholeFile, AFullDiskLeavesTheOldOneAndNoPart) {
    const fs::path part = file.string() + ".part";
    fs::create_symlink("/dev/full", part);
    EXPECT_EQ(complaint(file), "cannot write " + file.string() + ": is the disk full?");
    EXPECT_EQ(content(), "old");
    EXPECT_FALSE(fs::is_symlink(part));
}

TEST_F(WholeFile, APlaceThatIsTakenIsAnError) {
    const fs::path taken = folder.path() / "taken";
    fs::create_directories(taken / "by a folder");
    EXPECT_EQ(complaint(taken).find("cannot write " + taken.string() + ": "), 0u);
    EXPECT_FALSE(fs::exists(taken.string() + ".part"));
    EXPECT_EQ(complaint(folder.path() / "nowhere" / "file").find("cannot write "), 0u);
}

// If the content cannot be produced, nothing is left behind either.
TEST_F(WholeFile, AnExceptionOfTheContentPasses) {
    const auto fails = [](std::ostream&) { throw std::out_of_range("no such thing"); };
    EXPECT_THROW(write_whole(file, fails), std::out_of_range);
    EXPECT_EQ(content(), "old");
    EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

}  // namespace
}  // namespace turbidite
