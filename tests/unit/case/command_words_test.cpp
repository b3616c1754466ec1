// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/files/command_words.hpp"

#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

using Words = std::vector<std::string>;

TEST(CommandWords, AreSeparatedBySpacesAndKeptTogetherByQuotes) {
    EXPECT_EQ(command_words("  python3 my.py  -v"), (Words{"python3", "my.py", "-v"}));
    EXPECT_EQ(command_words("a 'b c' \"d'e\" '' f'g h'i"), (Words{"a", "b c", "d'e", "", "fg hi"}));
    // Of a text over several lines of a YAML file
    EXPECT_EQ(command_words("a --b 1\n\t--c 2\n"), (Words{"a", "--b", "1", "--c", "2"}));
    EXPECT_FALSE(command_words("a 'b"));
    EXPECT_FALSE(command_words("   "));
}

TEST(CommandWords, ComeBackFromTheirText) {
    for (const Words& words :
         {Words{"a", "b c", "", "d'e f"}, Words{"/x/y", "-n", "3"}, Words{"a\tb", "c\nd"}})
        EXPECT_EQ(command_words(command_text(words)), words);
}

TEST(CommandWords, AProgramIsFoundInPathOrByItsPath) {
    EXPECT_EQ(find_program_file("no-such-program-anywhere"), "");
    EXPECT_EQ(find_program_file("sh").filename(), "sh");
    EXPECT_EQ(find_program_file("/bin/sh"), "/bin/sh");
    EXPECT_EQ(find_program_file("/etc/passwd"), "") << "not executable";
}

class External : public CaseTest {
 protected:
    External()
        : CaseTest(
              "domain: {size: [12, 24]}\n"
              "grains: {count: 20, adapter: external}\n"
              "fluid: {reynolds: 36}\n"
              "time: {step: 0.01, end: 1}\n") {}
};

TEST_F(External, NeedsACommand) {
    EXPECT_SAYS(refusal(""), "grains.command");
    EXPECT_SAYS(refusal("", {"grains.command=python3 'my.py"}), "Close every quote");
    EXPECT_EQ(refusal("", {"grains.command=my-code"}), "");
}

TEST_F(External, FilesAreRelativeToTheCaseFile) {
    const auto file = folder.write("my.py", "");
    const std::string command =
        load("", {"grains.command=python3 my.py -v other"}).settings.text("grains.command");
    EXPECT_EQ(command, "python3 " + file.string() + " -v other");
}

TEST_F(External, MayUseAnyKeyOfContactsAndAnyNumberOfRanks) {
    const ResolvedCase resolved =
        load("", {"grains.command=x", "grains.ranks=3", "contact.md_substeps=30",
                  "contact.iterations=7", "coupling.scheme=split"});
    for (const std::string& note : resolved.notes)
        EXPECT_EQ(note.find("no effect"), std::string::npos) << note;
    EXPECT_GT(resolved.settings.integer("run.md_substeps"), 0);
    EXPECT_SAYS(refusal("", {"grains.ranks=3", "grains.adapter=yade-nscd"}),
                "yade-nscd runs on one rank");
}

TEST_F(External, ACommandWithoutItHasNoEffect) {
    const auto notes = load("", {"grains.command=x", "grains.adapter=yade-nscd"}).notes;
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
        return note == "grains.command has no effect with grains.adapter: yade-nscd";
    }));
}

}  // namespace
}  // namespace turbidite
