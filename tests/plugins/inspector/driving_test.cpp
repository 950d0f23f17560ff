// Viewers that drive by hand, and panels of operators.

#include "tests/plugins/inspector/inspector_fixture.h"

namespace runnel::test {
namespace {

using Driving = RunningInspectorTest;

constexpr const char* kIn = "/app/b/input/in";

auto Hands(const Json& expected) {
  return [expected](const Json& each) { return each["op"] == "state" && each["hands"] == expected; };
}
Json Hand(const char* state) { return Json::array({{{"path", kIn}, {"state", state}}}); }

TEST_F(Driving, WhoIsNotHeardOfIsToldToAllViewersAsLost) {
  Start();
  Viewer viewer = View();
  Viewer other = View();
  other.Next(Hands(Json::array()), "nobody drives");
  const Json publish{{"op", "publish"}, {"path", kIn}, {"value", "7"}, {"lease", "a"}};
  Json drive = publish;
  drive["deadline"] = 0.5;  // not over before it is read, whatever else runs
  EXPECT_EQ(viewer.Ask(drive)["ok"], true);
  other.Next(Hands(Hand("lost")), "nobody has been heard of");
  other.Send({{"op", "watch"}, {"path", kIn}, {"rate", 60}});
  EXPECT_EQ(other.Value(kIn)["value"], 0);
  for (const Json& late : {drive, publish}) {
    EXPECT_THAT(viewer.Ask(late)["errors"][0]["message"], HasSubstr("this hold has ended"));
  }
  EXPECT_EQ(viewer.Ask({{"op", "release"}, {"path", kIn}})["ok"], true);
  other.Next(Hands(Json::array()), "released");
}

TEST_F(Driving, AStopHoldsUntilItIsReleased) {
  ASSERT_TRUE(PortAt(kIn).SetLimits({.default_value = 0}));
  Start();
  Viewer viewer = View();
  Viewer other = View();
  EXPECT_EQ(viewer.Ask({{"op", "block"}, {"path", kIn}})["ok"], true);
  other.Next(Hands(Hand("stopped")), "stopped");
  const Json refused = other.Ask({{"op", "publish"}, {"path", kIn}, {"value", "7"}});
  EXPECT_EQ(refused["ok"], false);
  EXPECT_EQ(refused["errors"][0]["hint"], "release it first");
  EXPECT_EQ(other.Ask({{"op", "release"}, {"path", kIn}})["ok"], true);
  EXPECT_EQ(other.Ask({{"op", "publish"}, {"path", kIn}, {"value", "7"}})["ok"], true);
}

TEST_F(Driving, MembersOfAnotherKindAreRefused) {
  Start();
  Viewer viewer = View();
  const auto with = [&](const char* name, const Json& value) {
    viewer.Send({{"op", "publish"}, {"path", kIn}, {"value", "7"}, {name, value}});
    return viewer.Next("reply")["ok"];
  };
  EXPECT_EQ(with("deadline", "soon"), false);
  EXPECT_EQ(with("deadline", -1), false);
  EXPECT_EQ(with("deadline", 1e300), false);
  EXPECT_EQ(with("lease", 7), false);
  EXPECT_EQ(with("lease", std::string(200, 'a')), false);
  EXPECT_EQ(with("stop", "yes"), false);
  EXPECT_EQ(with("stop", true), false) << "that is called 'block'";
}

TEST_F(Driving, APanelIsKeptAndGivenToAllViewers) {
  Start();
  Viewer viewer = View();
  const Json none = viewer.Ask({{"op", "panel"}});
  EXPECT_EQ(none["text"], "");
  EXPECT_EQ(none["file"], nullptr);
  const char* const panel = R"({"panel": 1, "widgets": []})";
  EXPECT_THAT(viewer.Ask({{"op", "save_panel"}, {"value", panel}})["text"], HasSubstr("in memory"));
  EXPECT_EQ(View().Ask({{"op", "panel"}})["text"], panel);
  const Json wrong = viewer.Ask({{"op", "save_panel"}, {"value", "{}"}});
  EXPECT_EQ(wrong["ok"], false);
  EXPECT_THAT(wrong["errors"][0]["message"], HasSubstr("\"panel\" is missing"));
  EXPECT_EQ(viewer.Ask({{"op", "panel"}})["text"], panel);
}

TEST_F(Driving, ReadOnlyAPanelIsSeenAndNothingDriven) {
  Start({.is_read_only = true});
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "panel"}})["ok"], true);
  for (const char* op : {"publish", "save_panel", "release"}) {
    EXPECT_THAT(viewer.Ask({{"op", op}, {"path", kIn}})["errors"][0]["message"], HasSubstr("read-only"));
  }
}

}  // namespace
}  // namespace runnel::test
