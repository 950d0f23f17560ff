// Planted offences, to show that the rules are able to fail.

#include "tests/architecture/source_rules.h"

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string ManyLines(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "int x;\n";
  return text;
}

TEST(SourceRulesTest, LinesOfALibraryAreCountedTogether) {
  const SourceTree tree = {{"core/port/a.h", ManyLines(6)},
                           {"core/port/deep/b.cpp", ManyLines(4)},
                           {"core/port/README.md", ManyLines(100)},
                           {"core/base/a.h", ManyLines(9)}};
  EXPECT_THAT(TooLargeLibraries(tree, 10), ElementsAre("core/port: 10 lines"));
  EXPECT_THAT(TooLargeLibraries(tree, 11), IsEmpty());
}

TEST(SourceRulesTest, LibrariesWithSourcesNeedAReadme) {
  const SourceTree tree = {{"core/port/a.h", ""},
                           {"core/base/a.h", ""},
                           {"core/base/README.md", ""},
                           {"core/cmake/tools.cmake", ""},
                           {"tests/core/a_test.cpp", ""}};
  EXPECT_THAT(LibrariesWithoutReadme(tree), ElementsAre("core/port"));
}

TEST(SourceRulesTest, PathsOfOneMachineAreFound) {
  const std::string work = std::string("/wo") + "rk/main";
  const SourceTree tree = {{"README.md", "fine\nsee " + work + "\n"},
                           {"a.cmake", "set(x \"" + work + "\")\n"},
                           {"b.md", "the frame" + work + " of reference, and ${HOME}" + work}};
  EXPECT_THAT(ForbiddenText(tree),
              ElementsAre("README.md:2: a path of one machine", "a.cmake:1: a path of one machine"));
}

TEST(SourceRulesTest, MarksOfUnfinishedThingsAreFound) {
  const SourceTree tree = {{"core/a.h", std::string("// TO") + "DO: later\n"}};
  EXPECT_THAT(ForbiddenText(tree), ElementsAre("core/a.h:1: a mark of something unfinished"));
}

TEST(SourceRulesTest, MarksOfWhatWasToBeFilledInAreFoundInDocuments) {
  const SourceTree tree = {{"README.md", std::string("## Measured\n\n@FIG") + "URES@\n"},
                           {"core/base/README.md", "write to me@example.org or you@EXAMPLE.org\n"},
                           {"core/cmake/file.in", "@VERSION@\n"}};
  EXPECT_THAT(ForbiddenText(tree), ElementsAre("README.md:3: a mark of something to be filled in"));
}

TEST(SourceRulesTest, NotesLeftBehindAreFound) {
  const SourceTree tree = {{"README.md", ""}, {"check", ""}, {"NOTES.md", ""}, {"core/notes", ""}};
  EXPECT_THAT(StrayFiles(tree), ElementsAre("NOTES.md"));
}

TEST(SourceRulesTest, LongFilesAreFound) {
  const SourceTree tree = {
      {"core/port/a.h", ManyLines(10)}, {"tests/core/b.cpp", ManyLines(11)}, {"core/port/README.md", ManyLines(100)}};
  EXPECT_THAT(TooLongFiles(tree, 10), ElementsAre("tests/core/b.cpp: 11 lines"));
}

TEST(SourceRulesTest, HeadersNeedTheirGuard) {
  EXPECT_THAT(HeadersWithoutGuard({{"core/a.h", "#pragma once\n"}, {"core/b.h", "int x;\n"}}), ElementsAre("core/b.h"));
}

}  // namespace
}  // namespace runnel::test
