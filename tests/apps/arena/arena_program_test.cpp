#include <csignal>
#include <cstdlib>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/arena/arena_run.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> KeysOf(const nlohmann::json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

TEST_F(ArenaTest, WritesTheRunsExactlyAsPublished) {
  const Ended ended = Arena(
      "--world one_obstacle --variant bug2 --sensor laser,infrared --seed 7 "
      "--direction right --quiet --path-step 0.5 --json " +
      File("runs.json"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  const auto runs = Json("runs.json");
  ASSERT_TRUE(runs.is_array());
  ASSERT_EQ(runs.size(), 2u);
  for (const auto& run : runs) {
    EXPECT_THAT(KeysOf(run),
                testing::UnorderedElementsAre("world", "variant", "sensor", "direction", "seed", "outcome",
                                              "path_length_m", "sim_time_s", "wall_time_s", "cycles", "hits", "leaves",
                                              "path", "noise_m", "remark", "is_right", "shortest_path_m", "ratio"));
    EXPECT_EQ(run["world"], "one_obstacle");
    EXPECT_EQ(run["variant"], "bug2");
    EXPECT_EQ(run["direction"], "right");
    EXPECT_EQ(run["seed"], 7);
    EXPECT_EQ(run["outcome"], "reached");
    EXPECT_GT(run["path_length_m"].get<double>(), 12.5);
    EXPECT_LT(run["path_length_m"].get<double>(), 25.0);
    EXPECT_GT(run["wall_time_s"].get<double>(), 0.0);
    EXPECT_NEAR(run["sim_time_s"].get<double>(), run["cycles"].get<double>() * 0.05, 0.1);
    ASSERT_EQ(run["hits"].size(), 1u);
    ASSERT_EQ(run["leaves"].size(), 1u);
    EXPECT_EQ(run["hits"][0].size(), 2u);
    EXPECT_LT(run["hits"][0][0].get<double>(), -1.0);
    EXPECT_GT(run["leaves"][0][0].get<double>(), 1.0);
    const auto& path = run["path"];
    EXPECT_THAT(path[0], ElementsAre(0.0, -6.0, 0.0, 0.0));
    double before = -1.0;
    for (const auto& point : path) {
      ASSERT_EQ(point.size(), 4u);
      EXPECT_GT(point[0].get<double>(), before);
      before = point[0].get<double>();
    }
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      EXPECT_GE(std::hypot(path[i][1].get<double>() - path[i - 1][1].get<double>(),
                           path[i][2].get<double>() - path[i - 1][2].get<double>()),
                0.499);
    }
    EXPECT_NEAR(path.back()[1].get<double>(), 6.0, 0.15);
  }
  EXPECT_EQ(runs[0]["sensor"], "laser");
  EXPECT_EQ(runs[1]["sensor"], "infrared");
}

TEST_F(ArenaTest, ItsRunsAreNotAmongTheRunningApplicationsThatAreOfferedToOthers) {
  const char* const before = std::getenv("XDG_RUNTIME_DIR");
  const std::string kept = before != nullptr ? before : "";
  setenv("XDG_RUNTIME_DIR", folder_.c_str(), 1);
  const Ended ended = Arena("--world one_obstacle --variant bug2 --quiet --json " + File("runs.json"));
  if (before != nullptr) {
    setenv("XDG_RUNTIME_DIR", kept.c_str(), 1);
  } else {
    unsetenv("XDG_RUNTIME_DIR");
  }
  EXPECT_EQ(ended.code, 0) << ended.text;
  // Whoever offers a socket makes the folder for it, which stays.
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runnel"));
}

TEST_F(ArenaTest, TellsOutcomeLengthRatioAndBoundOnTheTerminal) {
  const Ended ended = Arena("--world one_obstacle unreachable --variant bug2 --quiet");
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_THAT(ended.text, AllOf(HasSubstr("one_obstacle: shortest path 12.58 m"),
                                HasSubstr("unreachable: the goal cannot be reached"), HasSubstr("25.00"),
                                HasSubstr("100.0 %"), HasSubstr("simulated seconds per real second and core")));
  EXPECT_THAT(ended.text, Not(HasSubstr("WRONG")));
}

TEST_F(ArenaTest, GivesTheSameRunsForTheSameSeed) {
  const std::string words = "--world one_obstacle --variant bug2 --noise 0.02 --quiet --seed 3,4 ";
  EXPECT_EQ(Arena(words + "--json " + File("a.json")).code, 0);
  EXPECT_EQ(Arena(words + "--jobs 1 --json " + File("b.json")).code, 0);
  auto a = Json("a.json"), b = Json("b.json");
  ASSERT_EQ(a.size(), 2u);
  for (auto* runs : {&a, &b}) {
    for (auto& run : *runs) run.erase("wall_time_s");
  }
  EXPECT_EQ(a, b);
  EXPECT_NE(a[0]["path"], a[1]["path"]) << "noise of another seed";
}

TEST_F(ArenaTest, DrawsEachRunAndAPageWithoutANetwork) {
  const Ended ended = Arena("--world one_obstacle --variant bug1,bug2 --quiet --svg " + File("pictures") + " --html " +
                            File("page.html"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  for (const std::string variant : {"bug1", "bug2"}) {
    const std::string picture = Text("pictures/one_obstacle-" + variant + "-laser-left-1.svg");
    EXPECT_THAT(picture, AllOf(HasSubstr("<svg"), HasSubstr("reached"), HasSubstr("</svg>")));
  }
  std::string page = Text("page.html");
  const std::string name = "xmlns=\"http://www.w3.org/2000/svg\"";  // is never asked for
  for (auto at = page.find(name); at != std::string::npos; at = page.find(name)) page.erase(at, name.size());
  EXPECT_THAT(page, AllOf(HasSubstr("<!doctype html>"), HasSubstr("prefers-color-scheme: dark"), HasSubstr("aria-sort"),
                          HasSubstr("12.58 m")));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("http:")), Not(HasSubstr("https:")), Not(HasSubstr("src=")),
                          Not(HasSubstr("@import"))));
  std::size_t figures = 0;
  for (auto at = page.find("<figure"); at != std::string::npos; at = page.find("<figure", at + 1)) {
    ++figures;
  }
  EXPECT_EQ(figures, 2u);
}

TEST_F(ArenaTest, DoesNotRepeatFinishedRuns) {
  const std::string json = " --json " + File("runs.json");
  ASSERT_EQ(Arena("--world one_obstacle --variant bug2 --quiet" + json).code, 0);
  auto before = Json("runs.json");
  const Ended ended = Arena("--world one_obstacle --variant bug1,bug2 --resume" + json);
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.text, HasSubstr("1 of 2 runs are finished already"));
  EXPECT_THAT(ended.text, HasSubstr("[1/1] one_obstacle bug1"));
  const auto after = Json("runs.json");
  ASSERT_EQ(after.size(), 2u);
  EXPECT_EQ(after[0]["variant"], "bug1");
  EXPECT_EQ(after[1], before[0]) << "with the same wall time: not run again";
}

TEST_F(ArenaTest, LeavesWhatIsFinishedWhenItIsStoppedAndGoesOnFromThere) {
  const std::string words =
      "arena --world one_obstacle spiral --variant bug1,bug2 --jobs 1 "
      "--sensor infrared --json " +
      File("runs.json");
  Program arena(words);
  ASSERT_TRUE(arena.WaitFor("[1/4]"));
  arena.Send(SIGINT);
  const Ended ended = arena.Wait();
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.text, HasSubstr("--resume goes on from here"));
  const auto finished = Json("runs.json");
  ASSERT_GE(finished.size(), 1u);
  ASSERT_LT(finished.size(), 4u);
  const Ended resumed = Runnel(words + " --resume");
  EXPECT_EQ(resumed.code, 0) << resumed.text;
  const auto all = Json("runs.json");
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0], finished[0]);
}

// Of enough runs that some are left, however late the kill comes.
TEST_F(ArenaTest, GoesOnAfterItHasBeenKilled) {
  const std::string words =
      "arena --world one_obstacle open cup comb spiral corridor --variant bug2 --jobs 1 "
      "--sensor infrared --json " +
      File("runs.json");
  Program arena(words);
  ASSERT_TRUE(arena.WaitFor("[1/6]"));
  arena.Send(SIGKILL);
  EXPECT_EQ(arena.Wait().signal, SIGKILL);
  EXPECT_THAT(Runnel(words + " --resume").text, ContainsRegex("[1-5] of 6 runs are finished already"));
  EXPECT_EQ(Json("runs.json").size(), 6u);
}

TEST_F(ArenaTest, RefusesToMixRunsOfOtherSettings) {
  const std::string words = "--world open --variant bug2 --quiet --json " + File("runs.json");
  ASSERT_EQ(Arena(words).code, 0);
  const Ended ended = Arena(words + " --resume --noise 0.1");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.text, HasSubstr("the finished runs had --noise 0, not 0.1"));
}

TEST_F(ArenaTest, DoesNotOverwriteRunsThatItCannotGoOnWith) {
  Write("runs.json", "[]");
  const Ended ended = Arena("--world open --variant bug2 --resume --quiet --json " + File("runs.json"));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.text, HasSubstr("have no journal"));
  EXPECT_EQ(Text("runs.json"), "[]");
}

struct Refusal {
  const char* words;
  const char* told;
};
class ArenaRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(ArenaRefuses, WithTheNearestName) {
  const Ended ended = Runnel(std::string("arena ") + GetParam().words);
  EXPECT_EQ(ended.code, 2) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr(GetParam().told));
}

INSTANTIATE_TEST_SUITE_P(
    BadWords, ArenaRefuses,
    testing::Values(Refusal{"--world spirale", "there is no world 'spirale'; did you mean 'spiral'?"},
                    Refusal{"--world " RUNNEL_XML "/worlds/comb1.xml", "/worlds/comb.xml'?"},
                    Refusal{"--world open --variant bugg1", "no variant 'bugg1'; did you mean 'bug1'?"},
                    Refusal{"--world open --sensor lazer", "there is no sensor 'lazer'; did you mean 'laser'?"},
                    Refusal{"--world open --direction rigth", "did you mean 'right'?"},
                    Refusal{"--world open --jobs 0", "--jobs must be between 1 and 1000"},
                    Refusal{"--world open --noise nan", "--noise must be between 0 and 10 m"},
                    Refusal{"--world open --seed=-1", "a seed is a whole number from 0 to 18446744073709551615"},
                    Refusal{"--world open --html /dev/null", "is not a file that could be replaced"},
                    Refusal{"--world open --resume", "--resume needs --json"},
                    Refusal{"--world open --json /nowhere/runs.json",
                            "/nowhere/runs.json: error: the file "
                            "cannot be written"},
                    Refusal{"--world open --svg /proc/pictures", "/proc/pictures"},
                    Refusal{"--world open --plugin nothing", "nothing"},
                    Refusal{"--variant bug1", "--world is required"}));

// What is known of one of the family is known of its name, however it is written.
TEST_F(ArenaTest, CallsOneOfTheFamilyByOneName) {
  Write("com.xml", R"(<module type="planning/bug1"/>)");
  const Ended refused = Arena("--world open --variant " + File("com.xml"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.text, HasSubstr("com.xml: error: 'com' is the name of planning/com; give the file another name"));
  const Ended ended =
      Arena("--world open --variant bug1,planning/bug1 --seed 010,10 --quiet --json " + File("runs.json"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_EQ(Json("runs.json").size(), 1U);
  EXPECT_EQ(Json("runs.json")[0]["variant"], "bug1");
  EXPECT_EQ(Json("runs.json")[0]["seed"], 10);
}

TEST_F(ArenaTest, MergesIntoWhatIsThere) {
  for (const std::string variant : {"bug1", "bug2", "com"}) {
    ASSERT_EQ(Arena("--world open --variant " + variant + " --quiet --json " + File(variant + ".json")).code, 0);
  }
  const Ended ended = Arena("merge " + File("bug1.json") + " " + File("bug2.json") + " " + File("com.json"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_EQ(Json("bug1.json").size(), 3U);
}

TEST_F(ArenaTest, TellsAllThatIsWrongAtOnce) {
  Write("bad.xml", "<world name=\"bad\"><start x=\"0\" y=\"0\"/></world>");
  const Ended ended = Arena("--world " + File("bad.xml") + " --variant bug9 --direction up");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("bad.xml:1:1"), HasSubstr("goal"), HasSubstr("'bug9'"), HasSubstr("'up'")));
}

}  // namespace
}  // namespace runnel::test
