#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/world_file/world_file.h"
#include "tests/apps/arena/arena_run.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class WorldProgram : public ArenaTest {};

TEST_F(WorldProgram, WritesTheSameBytesForTheSameSeed) {
  for (const std::string kind : {"scatter", "maze", "spiral", "comb", "ring"}) {
    const std::string words = "world --kind " + kind + " --seed 12";
    ASSERT_EQ(Runnel(words + " --out " + File("a.xml")).code, 0);
    ASSERT_EQ(Runnel(words + " --out " + File("b.xml")).code, 0);
    EXPECT_EQ(Text("a.xml"), Text("b.xml"));
    EXPECT_EQ(Runnel(words).text, Text("a.xml"));
    EXPECT_THAT(Text("a.xml"), StartsWith("<!-- Made by runnel world: kind " + kind + ", seed 12 -->\n"));
    Diagnostics diagnostics;
    const auto world = ReadWorldFile(File("a.xml"), diagnostics);
    ASSERT_TRUE(world) << diagnostics.ToString();
    EXPECT_EQ(world->name, kind + "_12");
  }
}

TEST_F(WorldProgram, SaysHowAWorldIsMadeAgain) {
  const std::string words = "world --kind scatter --seed 5 --width 20 --height 9.5 --gap 1.25 --count 4 --enclosed";
  EXPECT_THAT(
      Runnel(words).text,
      StartsWith(
          "<!-- Made by runnel world: kind scatter, seed 5, width 20, height 9.5, gap 1.25, count 4, enclosed -->\n"));
}

TEST_F(WorldProgram, RefusesWhatItCannotMake) {
  const auto expect_refusal = [](const std::string& words, const std::string& told) {
    const Ended ended = Runnel("world " + words);
    EXPECT_EQ(ended.code, 2) << words;
    EXPECT_THAT(ended.text, HasSubstr(told));
  };
  expect_refusal("--kind mase", "there is no kind of world called 'mase'; did you mean 'maze'?");
  expect_refusal("--kind maze --gap 0.3", "the gap must be between 0.7 and 5, not 0.3");
  expect_refusal("--seed 3", "--kind is required");
  for (const char* const seed : {"-1", "0x10", "1.5", "18446744073709551616", "one"}) {
    expect_refusal("--kind maze --seed=" + std::string(seed),
                   "a seed is a whole number from 0 to 18446744073709551615");
  }
  EXPECT_EQ(Runnel("world --kind maze --out /nowhere/maze.xml").code, 1);
}

TEST_F(WorldProgram, ReadsNumbersWithZerosBeforeThemAsDecimals) {
  EXPECT_THAT(Runnel("world --kind ring --seed 010 --count 011").text, HasSubstr("kind ring, seed 10, count 11 -->"));
  EXPECT_THAT(Runnel("world --kind ring --seed 08").text, HasSubstr("kind ring, seed 8 -->"));
}

TEST_F(WorldProgram, IsACommandThatIsFoundBesideTheProgram) {
  EXPECT_THAT(Runnel("--help").text, HasSubstr("arena, generate, info, keys, manifest, new, ros2, world"));
  const Ended ended = Runnel("wrld");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.text, HasSubstr("did you mean 'world'?"));
}

}  // namespace
}  // namespace runnel::test
