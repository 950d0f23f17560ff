#include "tests/plugins/inspector/inspector_fixture.h"

namespace runnel::test {

namespace {

using Changing = RunningInspectorTest;
using SimulatedChanging = SimulatedInspectorTest;

TEST_F(Changing, IsAnsweredAndToldToAllViewers) {
  Start();
  Viewer viewer = View();
  Viewer other = View();
  other.Next("structure");
  const Json reply = viewer.Change({"create /app/c test/sink", "connect /app/a/out /app/c/in queue=3"});
  EXPECT_EQ(reply["ok"], true) << reply.dump();
  EXPECT_THAT(reply["text"], HasSubstr("done; threads stood still for"));
  const Json told = other.Next("structure_change");
  EXPECT_EQ(told["elements"][0]["path"], "/app/c");
  ASSERT_EQ(told["connected"].size(), 1U);
  EXPECT_EQ(told["connected"][0]["to"], "/app/c/input/in");
  EXPECT_EQ(told["connected"][0]["queue"], 3);
  EXPECT_THAT(told["gone"], IsEmpty());
  EXPECT_EQ(viewer.Change({"delete /app/c"})["ok"], true);
  const Json gone = other.Next("structure_change");
  EXPECT_EQ(gone["gone"], Json({"/app/c", "/app/c/input", "/app/c/input/in"}));
  EXPECT_EQ(gone["disconnected"].size(), 1U);
}

TEST_F(Changing, IsAllOrNothingAndSaysWhichChangeIsWrong) {
  Start();
  Viewer viewer = View();
  const Json reply = viewer.Change({"set /app/a/speed 2", "set /app/a/sped 3", "set /app/a/speed 99"});
  EXPECT_EQ(reply["ok"], false);
  ASSERT_EQ(reply["errors"].size(), 2U) << reply.dump();
  EXPECT_EQ(reply["errors"][0]["change"], 1);
  EXPECT_EQ(reply["errors"][0]["hint"], "did you mean 'speed'?");
  EXPECT_EQ(reply["errors"][1]["change"], 2);
  EXPECT_THAT(reply["errors"][1]["hint"], HasSubstr("0 .. 9"));
  EXPECT_EQ(View().Element("/app/a/parameter/speed")["value"], "1");
}

TEST_F(Changing, LogLevelsAreSetAndToldToAllViewers) {
  Start();
  Viewer viewer = View();
  Viewer other = View();
  const auto levels = [](const Json& expected) {
    return [expected](const Json& each) { return each["op"] == "state" && each["log_levels"] == expected; };
  };
  other.Next(levels(Json::object()), "state without levels");
  const Json reply = viewer.Ask({{"op", "log"}, {"path", "/app/a"}, {"level", "debug"}});
  EXPECT_EQ(reply["text"], "/app/a: logs debug and more");
  other.Next(levels({{"/app/a", "debug"}}), "state with the level");
  viewer.Ask({{"op", "log"}, {"path", "/app/a"}, {"level", "inherit"}});
  other.Next(levels(Json::object()), "state without levels again");
  const Json wrong = viewer.Ask({{"op", "log"}, {"path", "/app/a"}, {"level", "debgu"}});
  EXPECT_THAT(wrong["errors"][0]["message"], HasSubstr("debug"));
}

TEST_F(Changing, TagsOfAnyElementReachAllViewers) {
  Start();
  Viewer viewer = View();
  Viewer other = View();
  other.Next("structure");
  for (const std::string path : {"/app/a", "/app/a/output/out", "/app/a/parameter/speed"}) {
    EXPECT_EQ(viewer.Change({"tag " + path + " loud new"})["ok"], true);
    const Json told = other.Next("structure_change");
    ASSERT_EQ(told["elements"].size(), 1U) << told.dump();
    EXPECT_EQ(told["elements"][0]["path"], path);
    EXPECT_EQ(told["elements"][0]["tags"], "loud new");
  }
}

TEST_F(Changing, WordsThatAreNoneAreToldWithTheNearest) {
  Start();
  const Json reply =
      View().ChangeAsTold({ChangeMessage("set /app/a/speed 2"), {{"change", "craete"}, {"path", "/app/c"}}});
  EXPECT_EQ(reply["errors"][0]["change"], 1);
  EXPECT_THAT(reply["errors"][0]["hint"], HasSubstr("create"));
  const Json member =
      View().ChangeAsTold(Json::array({{{"change", "set"}, {"path", "/app/a/speed"}, {"value", "2"}, {"vale", "3"}}}));
  EXPECT_EQ(member["errors"][0]["message"], "'set': has no \"vale\"");
  EXPECT_EQ(member["errors"][0]["hint"], "did you mean 'value'?");
  EXPECT_EQ(View().ChangeAsTold(Json::array())["ok"], false);
  EXPECT_EQ(View().ChangeAsTold(Json::array({"delete /app/a"}))["ok"], false);
  EXPECT_EQ(View().ChangeAsTold(Json::array({{{"change", "delete"}}}))["ok"], false);
}

TEST_F(Changing, TakesNamesAndValuesAsTheyAreWhateverIsInThem) {
  Start();
  Viewer viewer = View();
  const std::string title = "a \"b\"; delete /app/a # \\ \n\t}{";
  const Json done = viewer.ChangeAsTold(Json::array(
      {{{"change", "create"}, {"path", "/app/c"}, {"type", "test/counter"}, {"settings", {{"title", title}}}}}));
  EXPECT_EQ(done["ok"], true) << done.dump();
  EXPECT_EQ(View().Element("/app/c/parameter/title")["value"], title);
}

TEST_F(Changing, EachKindOfChangeIsReadAndADetailThatIsWrongIsNamed) {
  Start();
  Viewer viewer = View();
  const auto told = [&](Json change) {
    const Json reply = viewer.ChangeAsTold(Json::array({std::move(change)}));
    return reply["ok"] == true ? "done" : reply["errors"][0]["message"].get<std::string>();
  };
  EXPECT_EQ(told({{"change", "create_group"}, {"path", "/app/g"}}), "done");
  EXPECT_EQ(told({{"change", "create_port"}, {"path", "/app/g/n"}, {"direction", "output"}, {"type", "int32"}}),
            "done");
  EXPECT_EQ(told({{"change", "disconnect"}, {"from", "/app/a/out"}, {"to", "/app/b/in"}}), "done");
  EXPECT_EQ(
      told({{"change", "connect"}, {"from", "/app/a/out"}, {"to", "/app/b/in"}, {"queue", 4}, {"on_full", "refuse"}}),
      "done");
  EXPECT_EQ(told({{"change", "move"}, {"path", "/app/g"}, {"thread", "main"}}), "done");
  EXPECT_EQ(told({{"change", "connect"}, {"from", "/app/a/out"}, {"to", "/app/b/in"}, {"on_full", "refus"}}),
            "'connect': \"on_full\" cannot be 'refus'");
  EXPECT_EQ(told({{"change", "connect"}, {"from", "/a"}, {"to", "/b"}, {"queue", -1}}),
            "'connect': \"queue\" must be a count, at most 1000000");
  EXPECT_EQ(told({{"change", "connect"}, {"from", "/a"}, {"to", "/b"}, {"pull", 1}}),
            "'connect': \"pull\" must be true or false");
  EXPECT_EQ(told({{"change", "connect"}, {"from", "/app/a/out"}, {"to", "/app/b/in"}, {"pull", true}}),
            "cannot be pulled: it has no provider");
  EXPECT_EQ(told({{"change", "create"}, {"path", "/x"}, {"type", "t"}, {"settings", {{"a", 1}}}}),
            "'create': the setting 'a' must be a text");
  EXPECT_EQ(told({{"change", "set"}, {"path", 3}, {"value", "2"}}), "'set': \"path\" must be a text");
}

TEST_F(Changing, ASwapKeepsThePathsAndIsNoLoss) {
  Start();
  Viewer viewer = View();
  viewer.Next("structure");
  EXPECT_EQ(viewer.Change({"replace /app/a with test/fast_counter"})["ok"], true);
  Viewer late = View();
  EXPECT_EQ(late.Element("/app/a")["type"], "test/fast_counter");
  EXPECT_EQ(viewer.Ask({{"op", "undo"}})["ok"], true);
  const Json told = viewer.Next(
      [](const Json& each) {
        return each["op"] == "structure_change" && !each["elements"].empty() &&
               each["elements"][0].value("type", "") == "test/counter";
      },
      "way back");
  EXPECT_EQ(told["elements"][0]["path"], "/app/a");
  EXPECT_EQ(told["gone"], Json({"/app/a/output/further"}));
  EXPECT_THAT(told["connected"], IsEmpty());  // the same ends as before
  EXPECT_THAT(told["disconnected"], IsEmpty());
}

TEST_F(Changing, ASwapThatFailsIsRefusedAfterItsProbation) {
  Start();
  const Json reply = View().Change({"replace /app/a with test/failing"});
  EXPECT_EQ(reply["ok"], false) << reply.dump();
  EXPECT_EQ(reply["errors"][0]["path"], "/app/a");
  EXPECT_THAT(reply["errors"][0]["message"], HasSubstr("the old one is back"));
}

TEST_F(Changing, IsUndoneAndDoneAgain) {
  Start();
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "undo"}})["ok"], false);
  viewer.Ask({{"op", "change"}, {"label", "faster"}, {"changes", Json::array({ChangeMessage("set /app/a/speed 3")})}});
  EXPECT_EQ(viewer.Ask({{"op", "undo"}})["text"], "undone: faster");
  EXPECT_EQ(View().Element("/app/a/parameter/speed")["value"], "1");
  const Json redone = View().Ask({{"op", "redo"}});
  EXPECT_EQ(redone["text"], "redone: faster");
  EXPECT_EQ(redone["client"], "viewer 1") << "it was the first viewer's change, whoever redoes it";
  EXPECT_EQ(View().Element("/app/a/parameter/speed")["value"], "3");
}

TEST_F(Changing, WhatOthersSetIsSeen) {
  Start();
  Viewer viewer = View();
  viewer.Next("structure");
  Set("/app/a/parameter/speed", "4.5");
  EXPECT_EQ(viewer.Element("/app/a/parameter/speed")["value"], "4.5");
}

TEST_F(Changing, NamesTheTypesThatCouldStandIn) {
  Start();
  Viewer viewer = View();
  viewer.Next("catalogue");
  const Json reply = viewer.Ask({{"op", "compatible"}, {"path", "/app/a"}});
  ASSERT_EQ(reply["ok"], true) << reply.dump();
  std::vector<std::string> types;
  for (const Json& each : reply["types"]) types.push_back(each["type"]);
  EXPECT_THAT(types, ElementsAre("test/counter", "test/failing", "test/fast_counter"));
  EXPECT_THAT(reply["types"][0]["lost"], IsEmpty());
  EXPECT_EQ(viewer.Change({"replace /app/a with test/fast_counter", "create /app/s test/sink"})["ok"], true);
  const Json none = viewer.Ask({{"op", "compatible"}, {"path", "/app/none"}});
  EXPECT_EQ(none["ok"], false);
  EXPECT_EQ(none["errors"][0]["path"], "/app/none");
}

TEST_F(Changing, NamesTheConversionsByWhichPortsOfDifferentTypesCouldBeConnected) {
  Start();
  Viewer viewer = View();
  ASSERT_EQ(viewer.Change({"create /app/s test/sink", "tag /app/s loud new"})["ok"], true);
  const Json reply = viewer.Ask({{"op", "conversions"}, {"from", "/app/a/output/out"}, {"to", "/app/s/input/in"}});
  ASSERT_EQ(reply["ok"], true) << reply.dump();
  EXPECT_THAT(reply["conversions"], testing::Contains(Json{{"part", ""}, {"convert", "round"}}));
  EXPECT_EQ(viewer.Ask({{"op", "conversions"}, {"from", "/app/a/output/ou"}, {"to", "/app/s/input/in"}})["ok"], false);
}

TEST_F(Changing, SavesAndReloadsByTheProgramsMeans) {
  hooks.save = [](const std::string& file) -> Result<std::string> { return "saved to " + file; };
  hooks.reload = [](const std::string& plugin) -> Result<std::string> {
    return Error{.message = "no plugin " + plugin};
  };
  hooks.save_configuration = [](const std::string& file) -> Result<std::string> {
    return "saved values to '" + file + "'";
  };
  Start();
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "save"}, {"file", "x.xml"}})["text"], "saved to x.xml");
  EXPECT_EQ(viewer.Ask({{"op", "save"}, {"what", "configuration"}})["text"], "saved values to ''");
  const Json reply = viewer.Ask({{"op", "reload"}, {"plugin", "test"}});
  EXPECT_EQ(reply["ok"], false);
  EXPECT_EQ(reply["errors"][0]["message"], "no plugin test");
}

TEST_F(Changing, SavesNowhereElseThanBesideTheApplication) {
  bool has_saved = false;
  hooks.save = [&](const std::string&) -> Result<std::string> {
    has_saved = true;
    return std::string("saved");
  };
  Start({.file = "/here/app.xml"});
  const Json reply = View().Ask({{"op", "save"}, {"file", "../etc/app.xml"}});
  EXPECT_EQ(reply["ok"], false);
  EXPECT_THAT(reply["errors"][0]["hint"], HasSubstr("/here"));
  EXPECT_FALSE(has_saved);
}

TEST_F(Changing, WhatTheProgramCannotIsSaid) {
  Start();
  const Json reply = View().Ask({{"op", "save"}});
  EXPECT_EQ(reply["ok"], false);
  EXPECT_THAT(reply["errors"][0]["message"], HasSubstr("cannot save"));
}

TEST_F(Changing, IsRefusedToViewersThatOnlyLook) {
  bool has_saved = false;
  hooks.save = [&](const std::string&) -> Result<std::string> {
    has_saved = true;
    return std::string("saved");
  };
  Start({.is_read_only = true});
  Viewer viewer = View();
  viewer.Next("catalogue");
  EXPECT_EQ(viewer.Change({"set /app/a/speed 2"})["ok"], false);
  for (const char* op : {"undo", "redo", "save", "pause", "resume", "step", "speed", "reload"}) {
    const Json reply = viewer.Ask({{"op", op}, {"speed", 1}});
    EXPECT_EQ(reply["ok"], false) << op;
    EXPECT_THAT(reply["errors"][0]["message"], HasSubstr("read-only")) << op;
  }
  EXPECT_EQ(viewer.Ask({{"op", "compatible"}, {"path", "/app/a"}})["ok"], true);
  EXPECT_FALSE(has_saved);
  EXPECT_EQ(View().Element("/app/a/parameter/speed")["value"], "1");
}

TEST_F(SimulatedChanging, PausesStepsAndSetsTheSpeed) {
  Start();
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "pause"}})["ok"], true);
  EXPECT_TRUE(scheduler.pace().is_paused());
  EXPECT_EQ(viewer.Ask({{"op", "step"}, {"cycles", 3}})["ok"], true);
  EXPECT_EQ(scheduler.pace().cycles_to_step(), 3U);
  EXPECT_EQ(viewer.Ask({{"op", "resume"}})["ok"], true);
  EXPECT_FALSE(scheduler.pace().is_paused());
  EXPECT_EQ(viewer.Ask({{"op", "speed"}, {"speed", 2.5}})["ok"], true);
  EXPECT_EQ(scheduler.pace().speed(), 2.5);
  EXPECT_EQ(viewer.Ask({{"op", "speed"}})["ok"], false);
  EXPECT_EQ(viewer.Ask({{"op", "speed"}, {"speed", 1e9}})["ok"], false);
  EXPECT_EQ(viewer.Ask({{"op", "step"}, {"cycles", 0}})["ok"], false);
}

TEST_F(Changing, ARealClockCannotBePaused) {
  Start();
  const Json reply = View().Ask({{"op", "pause"}});
  EXPECT_EQ(reply["ok"], false);
  EXPECT_THAT(reply["errors"][0]["message"], HasSubstr("real"));
}

}  // namespace

}  // namespace runnel::test
