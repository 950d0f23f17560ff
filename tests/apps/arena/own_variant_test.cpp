#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/arena/arena_run.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

class OwnVariant : public ArenaTest {
 protected:
  static std::string ReadAll(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
};

// What the tutorial shows is what is compiled and run here.
TEST_F(OwnVariant, InTheTutorialIsTheOneThatIsCompiled) {
  const std::string tutorial = ReadAll(RUNNEL_VARIANTS "/own_variant.md");
  EXPECT_THAT(tutorial,
              HasSubstr("```cpp\n" + ReadAll(RUNNEL_ARENA_TESTS "/patient_bug.cpp") + "```\n"));
  EXPECT_THAT(tutorial, HasSubstr("```xml\n" + ReadAll(RUNNEL_ARENA_TESTS "/lefty.xml") + "```\n"));
}

TEST_F(OwnVariant, OfAnOutsidePluginFindsItsWay) {
  const Ended ended = Arena(
      "--world one_obstacle paper_1_unreachable hook --plugin patient_bug "
      "--variant patient/bug --quiet --json " +
      File("runs.json"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  const auto runs = Json("runs.json");
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0]["outcome"], "reached");
  EXPECT_EQ(runs[1]["outcome"], "unreachable");
  EXPECT_EQ(runs[2]["outcome"], "reached");
}

TEST_F(OwnVariant, ComposedInXmlFindsItsWay) {
  const Ended ended = Arena("--world one_obstacle paper_1_unreachable --variant " RUNNEL_ARENA_TESTS
                            "/lefty.xml --quiet --json " +
                            File("runs.json"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  const auto runs = Json("runs.json");
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0]["variant"], "lefty");
  EXPECT_EQ(runs[0]["outcome"], "reached");
  EXPECT_EQ(runs[1]["outcome"], "unreachable");
}

TEST_F(OwnVariant, WithoutATypeIsRefusedWithItsPlace) {
  Write("mine.xml", "<module>\n</module>\n");
  const Ended ended = Arena("--world open --variant " + File("mine.xml"));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.text, HasSubstr("mine.xml:1:1: error: a variant is a <module> tag"));
}

}  // namespace
}  // namespace runnel::test
