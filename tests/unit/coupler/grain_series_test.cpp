// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/grain_series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "coupler/output/contact_series.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

std::string slurp(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

// A viewer may open the series at any moment of a run: after every write it must end with its
// closing tags, once, and list every file so far.
TEST(GrainSeries, IsCompleteAfterEveryWrite) {
    const TestFolder folder("series");
    GrainSeries series(folder.path(), {{"disc", {}}});
    const Motion state{test_population(), {}};
    for (int step = 0; step < 3; ++step) {
        series.write(0.5 * step, 10 * step, 0.01, state, {});
        const std::string text = slurp(folder.path() / "grains.pvd");
        const std::string end = "</Collection>\n</VTKFile>\n";
        ASSERT_GE(text.size(), end.size());
        EXPECT_EQ(text.find(end), text.size() - end.size()) << text;
        for (int k = 0; k <= step; ++k) {
            const std::string name = "grains_000000" + std::to_string(k) + "0.vtp";
            EXPECT_NE(text.find("file=\"" + name + "\""), std::string::npos) << text;
            EXPECT_TRUE(std::filesystem::exists(folder.path() / name));
        }
    }
    EXPECT_NE(slurp(folder.path() / "grains.pvd").find("timestep=\"1\""), std::string::npos);
}

/// The text between the first `head` and the next "</DataArray>".
std::string array_of(const std::string& text, const std::string& name) {
    const auto at = text.find("Name=\"" + name + "\"");
    if (at == std::string::npos) return "no array " + name;
    const auto begin = text.find(">\n", at) + 2;
    return text.substr(begin, text.find("</DataArray>", begin) - begin);
}

// Forces and torques go to the grain that a kick names; a grain without a kick has none.
TEST(GrainSeries, ForcesAndTorquesAreThoseOfTheKicks) {
    const TestFolder folder("forces");
    GrainSeries series(folder.path(), {{"disc", {}}});
    Kick kick;
    kick.id = 102;
    kick.force = {1.5, -2.0, 0.0};
    kick.torque = {0.0, 0.0, 0.25};
    series.write(0.0, 1, 0.01, {test_population(), {}}, {kick});
    const std::string text = slurp(folder.path() / "grains_00000001.vtp");
    EXPECT_EQ(array_of(text, "force"), "0 0 0\n0 0 0\n1.5 -2 0\n");
    EXPECT_EQ(array_of(text, "torque"), "0 0 0\n0 0 0\n0 0 0.25\n");
}

// A triangle rotated by 90 degrees at (3, 2), R = 2, beside a disc. Shapes without corners have no
// outline.
TEST(GrainSeries, DrawsPolygonsWhereTheyAre) {
    const TestFolder folder("outlines");
    const double h = std::sqrt(3.0) / 2.0;
    GrainSeries series(folder.path(), {{"disc", {}}, {"triangle", {}}});
    Motion state{{test_population()[0], test_population()[1]}, {}};
    state.grains[1].shape = 1;
    state.grains[1].radius = 2.0;
    state.grains[1].position = {3.0, 2.0, 0.0};
    state.grains[1].orientation = {std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
    series.write(0.0, 7, 0.01, state, {});
    const std::string collection = slurp(folder.path() / "grains.pvd");
    EXPECT_NE(collection.find("part=\"0\" file=\"grains_00000007.vtp\""), std::string::npos)
        << collection;
    EXPECT_NE(collection.find("part=\"1\" file=\"outlines_00000007.vtp\""), std::string::npos)
        << collection;
    EXPECT_EQ(array_of(slurp(folder.path() / "grains_00000007.vtp"), "shape"), "0\n1\n");
    const std::string outlines = slurp(folder.path() / "outlines_00000007.vtp");
    EXPECT_NE(
        outlines.find(
            "NumberOfPoints=\"3\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfPolys=\"1\""),
        std::string::npos)
        << outlines;
    EXPECT_EQ(array_of(outlines, "id"), "101\n");
    EXPECT_EQ(array_of(outlines, "offsets"), "3\n");
    // Corners of the upright triangle: (0, 1), (-h, -1/2), (h, -1/2); rotated: (-1, 0), (1/2, -h),
    // (1/2, h).
    std::istringstream numbers(array_of(outlines, "position"));
    double right = 0.0, top = -10.0, left = 10.0;
    for (double x, y, z; numbers >> x >> y >> z;)
        right = std::max(right, x), top = std::max(top, y), left = std::min(left, x);
    EXPECT_NEAR(left, 3.0 - 2.0, 1e-8);
    EXPECT_NEAR(right, 3.0 + 1.0, 1e-8);
    EXPECT_NEAR(top, 2.0 + 2.0 * h, 1e-8);
}

ContactRecord wall_contact() {
    ContactRecord contact;
    contact.wall = 2;
    contact.b = 101;
    contact.status = ContactStatus::sliding;
    contact.gap = -0.125;
    contact.point = {4.5, 4.5, 0};
    contact.normal = {0, 1, 0};
    contact.branch = {0, 0.5, 0};
    contact.impulse = {-0.25, 0.5, 0};
    return contact;
}

// Grains at (2, 5) and (4.5, 5), step 0.5. At the wall the normal is e_y, so the tangent -e_x.
TEST(ContactSeries, HasALineAndTheForcesOfEveryContact) {
    const TestFolder folder("contacts");
    ContactSeries series(folder.path());
    Motion state{{test_population()[0], test_population()[1]}, {}};
    series.write(0.0, 0, 0.5, state);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "contacts.pvd"))
        << "nobody tells contacts";
    ContactRecord pair;
    pair.a = 100;
    pair.b = 101;
    pair.normal = {1, 0, 0};
    pair.branch = {2.5, 0, 0};
    pair.impulse = {3, 1, 0};
    pair.rolling_impulse = {0, 0, 2};
    state.contacts = {pair, wall_contact()};
    series.write(1.5, 4, 0.5, state);
    EXPECT_NE(slurp(folder.path() / "contacts.pvd")
                  .find("timestep=\"1.5\" part=\"0\" file=\"contacts_00000004.vtp\""),
              std::string::npos);
    const std::string text = slurp(folder.path() / "contacts_00000004.vtp");
    EXPECT_EQ(array_of(text, "position"), "2 5 0\n4.5 5 0\n4.5 4.5 0\n4.5 5 0\n");
    EXPECT_EQ(array_of(text, "connectivity"), "0 1\n2 3\n");
    EXPECT_EQ(array_of(text, "offsets"), "2\n4\n");
    EXPECT_EQ(array_of(text, "id_a"), "100\n-3\n") << "-1 - 2: the bottom";
    EXPECT_EQ(array_of(text, "id_b"), "101\n101\n");
    EXPECT_EQ(array_of(text, "normal_force"), "6\n6\n1\n1\n") << "once per end of the line";
    EXPECT_EQ(array_of(text, "tangential_force"), "2\n0.5\n");
    EXPECT_EQ(array_of(text, "rolling_moment"), "4\n0\n");
    EXPECT_EQ(array_of(text, "force"), "6 2 0\n-0.5 1 0\n");
    EXPECT_EQ(array_of(text, "gap"), "0\n-0.125\n");
    EXPECT_EQ(array_of(text, "status"), "0\n1\n");
    EXPECT_NE(text.find("<CellData Scalars=\"normal_force\""), std::string::npos);
}

// A time without contacts also has a file: the series has no gaps.
TEST(ContactSeries, IsThereWithoutContactsToo) {
    const TestFolder folder("no-contacts");
    ContactSeries series(folder.path());
    Motion state{test_population(), {}};
    state.contacts.emplace();
    series.write(0.0, 0, 0.5, state);
    state.contacts = {wall_contact()};
    series.write(0.5, 1, 0.5, state);
    const std::string text = slurp(folder.path() / "contacts.pvd");
    EXPECT_NE(text.find("contacts_00000000.vtp"), std::string::npos);
    EXPECT_EQ(text.find("</VTKFile>"), text.size() - std::string("</VTKFile>\n").size());
}

TEST(ContactSeries, AFullDiskIsAnErrorAndLeavesNoHalfFile) {
    const TestFolder folder("full-contacts");
    std::filesystem::create_symlink("/dev/full", folder.path() / "contacts_00000001.vtp.part");
    ContactSeries series(folder.path());
    Motion state{test_population(), {}};
    state.contacts = {wall_contact()};
    EXPECT_THROW(series.write(0.5, 1, 0.5, state), Failure);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "contacts_00000001.vtp"));
    EXPECT_FALSE(std::filesystem::is_symlink(folder.path() / "contacts_00000001.vtp.part"));
    EXPECT_EQ(slurp(folder.path() / "contacts.pvd").find("contacts_00000001"), std::string::npos);
}

}  // namespace
}  // namespace turbidite
