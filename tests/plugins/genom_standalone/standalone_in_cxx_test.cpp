// A component whose codels are in C++ as a process; the same objects as of the module in tests/plugins/genom_modules.

#include <gmock/gmock.h>

#include "tests/plugins/genom_standalone/standalone_process.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

TEST(StandaloneInCxxTest, RunsTheSameCodelsAsTheModule) {
  StandaloneProcess mill(RUNNEL_TEST_MILL, {"--stepped"});
  const auto ask = [&](const std::string& line) {
    mill.Say(line);
    return mill.Hear();
  };
  ask(R"({"step": 0})");
  ask(R"({"put": {"seen": {"at": {"x": 1, "y": 2}, "trace": [{"x": 3, "y": 4}], "level": 5}, "grain/left": 2.5}})");
  ask(R"({"step": 0.02})");
  EXPECT_EQ(ask(R"({"get": "ground"})")["done"],
            Json::parse(R"({"at":{"x":2.0,"y":2.0},"where":"left","name":"","grid":[[0,0],[0,0]],
                            "trace":[{"x":3.0,"y":4.0},{"x":1.0,"y":2.0}],"level":5})"));
  EXPECT_EQ(ask(R"({"get": "way"})")["done"], Json::parse(R"([{"x":1.0,"y":2.0}])"));
  const auto after_a_step = [&](const std::string& line) {
    mill.Say(line);
    mill.Say(R"({"as": "step", "step": 0.02})");
    Json heard = mill.Hear(), answer;
    for (; !heard.contains("as"); heard = mill.Hear()) {
      if (!heard.contains("accepted")) answer = heard;
    }
    return answer;
  };
  EXPECT_EQ(after_a_step(R"({"call": "set_gain", "with": {"gain": 3}})"), Json::parse(R"({"done":{}})"));
  EXPECT_EQ(after_a_step(R"({"call": "beep", "with": {"times": 4}})")["done"]["sum"], 8);
  EXPECT_EQ(after_a_step(R"({"call": "set_gain", "with": {"gain": 11}})"),
            Json::parse(R"({"failed":"mill::jammed","detail":{"which":"left","by":"gain"}})"));
  EXPECT_EQ(after_a_step(R"({"call": "beep", "with": {"times": 11}})"),
            Json::parse(R"({"failed":"beeper::tired","detail":{"which":"right","limit":11}})"));
  EXPECT_EQ(after_a_step(R"({"call": "set_gain", "with": {"gain": -1}})")["failed"], "mill::worn");
  EXPECT_EQ(after_a_step(R"({"call": "pour", "with": {"from": "left", "to": "a", "names": ["one", "two"]}})"), Json());
  EXPECT_EQ(
      after_a_step(R"({"call": "get_trace"})")["done"]["trace"],
      Json::parse(R"(["begin","nothing seen","pass","check","pass","beep","pass","check","pass","beep","pass","check",
                            "pass","pass","open","pour"])"));
}

TEST(StandaloneInCxxTest, TakesValuesOfEveryKind) {
  StandaloneProcess mill(RUNNEL_TEST_MILL);
  const std::string all =
      R"({"corners":[{"x":1.0,"y":2.0}],"level":7,"words":["up","down"],"flags":[true,false],"load":{"name":"hay"}})";
  EXPECT_EQ(mill.Ask({{"call", "set_all"}, {"with", Json::parse(all)}}), Json::parse(R"({"done":{}})"));
  Json got = mill.Ask({{"call", "get_all"}})["done"];
  got.erase("last");
  EXPECT_EQ(got, Json::parse(all));
  EXPECT_EQ(mill.Ask(Json::parse(R"({"call":"say","with":{"seen":{"at":{"y":3}}}})"))["done"]["said"],
            "a \"word\" right 11 3 2");
  EXPECT_THAT(
      mill.Ask(Json::parse(R"({"call":"set_all","with":{"corners":[{},{},{},{}]}})"))["error"].get<std::string>(),
      HasSubstr("corners: has more than 3"));
  Json partly = Json::parse(all);
  partly["corners"][0].erase("y");
  EXPECT_THAT(mill.Ask({{"call", "set_all"}, {"with", partly}})["error"].get<std::string>(),
              HasSubstr("corners[0].y: is not given"));
  partly = Json::parse(all);
  partly["words"].erase(1);
  EXPECT_THAT(mill.Ask({{"call", "set_all"}, {"with", partly}})["error"].get<std::string>(),
              HasSubstr("words: has fewer than 2 elements"));
  partly = Json::parse(all);
  partly.erase("level");
  EXPECT_THAT(mill.Ask({{"call", "set_all"}, {"with", partly}})["error"].get<std::string>(),
              HasSubstr("level: is not given"))
      << "arguments are all given";
}

}  // namespace
}  // namespace runnel::test
