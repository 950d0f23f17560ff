// What is said of wrong application files: place, path, cure.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

TEST(ApplicationErrors, NameTheNearestModuleType) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/sorce"/>
</application>)"),
            "app.xml:2:26: error: /demo/a: there is no module type 'test/sorce'; "
            "did you mean 'test/source'?\n");
}

TEST(ApplicationErrors, NameTheNearestTagAndAttribute) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <modul name="a" type="test/source"/>
  <module nmae="b" type="test/sink"/>
  <connect to="b/value">hello</connect>
  <group name="g">hello</group>
</application>)"),
            "app.xml:2:3: error: /demo: no <modul> may stand in <application>; did you mean "
            "'module'?\n"
            "app.xml:3:11: error: /demo: <module> knows no 'nmae'; did you mean 'name'?\n"
            "app.xml:4:3: error: /demo: <connect> has no 'from'; add from=\"…\": an output, or an "
            "interface port\n"
            "app.xml:5:19: error: /demo/g: no text may stand in <group>; leave out 'hello'\n");
}

TEST(ApplicationErrors, TellOfTagsInTheWrongPlace) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <port name="x" direction="input" type="double"/>
  <application name="x"/>
</application>)"),
            "app.xml:2:3: error: /demo: no <port> may stand in <application>; it stands in <group>: "
            "a port in the interface of its group; costs nothing at run time\n"
            "app.xml:3:3: error: /demo: no <application> may stand in <application>; it is the root "
            "of a file: a group that holds everything\n");
}

TEST(ApplicationErrors, TellOfNamesThatAreTaken) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <group name="a"/>
</application>)"),
            "app.xml:3:16: error: /demo/a: there is already an element called 'a' in /demo; the "
            "first is in line 2\n");
}

TEST(ApplicationErrors, TellOfNamesThatAreNone) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <group name="a/b"/>
  <group name="a b"/>
</application>)"),
            "app.xml:2:16: error: /demo: the name 'a/b' contains a '/', which separates names in "
            "paths\n"
            "app.xml:3:16: error: /demo: the name 'a b' contains a blank, which separates paths; "
            "write '_' instead\n");
}

TEST(ApplicationErrors, ComeAllAtOnce) {
  Workshop workshop;
  workshop.Build(R"(<application name="demo">
  <load plugin="no_such_plugin"/>
  <modul/>
  <module name="a" type="test/source" nam="red">
    <parameter name="gain" value="11"/>
    <parameter name="gian" value="1"/>
  </module>
  <module name="a" type="test/sink"/>
  <module name="filter" type="test/filter"/>
  <group name="g">
    <module name="b" type="test/sinc"/>
  </group>
  <connect from="a/vale" to="a/value"/>
</application>)");
  std::vector<int> lines;
  for (const Error& error : workshop.diagnostics.errors()) lines.push_back(error.position.line);
  std::ranges::sort(lines);
  EXPECT_THAT(lines, ::testing::ElementsAre(2, 3, 4, 5, 6, 8, 11, 13)) << workshop.diagnostics.ToString();
}

// Elements without a name of their own are called so while a wrong file is looked at.
TEST(ApplicationErrors, DoNotTakeANameForThatOfAnElementWithout) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(<application name="?demo">
  <module name="?" type="test/source"/>
  <group name="?2"><module name="?loc" type="test/sink"/></group>
  <connect from="?/value" to="?2/?loc/value"/>
</application>)"))
      << workshop.diagnostics.ToString();
  EXPECT_EQ(workshop.Get<Source>("/?demo/?").value.outgoing().size(), 1u);
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module type="test/source"/>
  <module name="?" type="test/sink"/>
  <connect from="gone/value" to="?/value"/>
</application>)"),
            "app.xml:2:3: error: /demo: <module> has no 'name'; add name=\"…\"\n");
}

TEST(ApplicationErrors, LeaveNothingHalfBuilt) {
  Workshop workshop;
  workshop.Build(R"(<application name="other"><module name="a" type="test/source"/></application>)");
  EXPECT_EQ(workshop.Build(R"(<application name="demo">
    <group name="inner"><module name="a" type="test/source"/></group>
    <module name="sink" type="test/sink"/>
    <connect from="/other/a/value" to="sink/value"/>
    <module name="b" type="test/sinc"/>
  </application>)"),
            nullptr);
  ASSERT_EQ(workshop.runtime.root().children().size(), 1u);
  EXPECT_EQ(workshop.runtime.root().children()[0]->name(), "other");
  EXPECT_TRUE(workshop.Get<Source>("/other/a").value.outgoing().empty());
  EXPECT_TRUE(workshop.Build(R"(<application name="demo"/>)")) << "the name is free again";
}

TEST(ApplicationErrors, OfAModuleThatCannotBecomeReadyLeaveNothingEither) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="sink" type="test/sink"/>
  <module name="x" type="test/unready"/>
</application>)"),
            "app.xml:3:3: error: /demo/x: the file is not there\n");
  EXPECT_TRUE(workshop.runtime.root().children().empty());
}

TEST(ApplicationErrors, OfModulesThatThrowNameThePlace) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="x" type="test/unmakeable"/>
</application>)"),
            "app.xml:2:3: error: /demo/x: a module of type 'test/unmakeable' could not be made: no "
            "such device\n");
}

TEST(ApplicationErrors, OfFilesThatAreNoApplications) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors("<configuration/>"),
            "app.xml:1:1: error: /: <configuration> is not an application; an application file "
            "begins with <application>\n");
  EXPECT_EQ(workshop.Errors("<module/>"),
            "app.xml:1:1: error: /: <module> is not an application; an application file begins "
            "with <application>\n");
  EXPECT_THAT(workshop.Errors("<application"), HasSubstr("app.xml:1:"));
  const BuildOutcome outcome =
      BuildApplication("/no/such/file.xml", {workshop.runtime, workshop.plugins, workshop.tags, workshop.configuration},
                       BuildMode::kRun);
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("/no/such/file.xml: error: "));
}

TEST(ApplicationErrors, InsideAnApplicationWithoutANameAreToldToo) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application>
  <module name="a"/>
</application>)"),
            "app.xml:1:1: error: /: <application> has no 'name'; add name=\"…\": the first "
            "part of all paths\n"
            "app.xml:2:3: error: /a: <module> has no 'type'; add type=\"…\": as `runnel "
            "modules` lists them\n");
}

TEST(ApplicationErrors, OfPluginsNameWhereTheyWereLookedFor) {
  Workshop workshop;
  // Unknown module types may come with the plugin, unless they look like a known one.
  EXPECT_THAT(workshop.Errors(R"(<application name="demo">
  <load plugin="simulatoin"/>
  <module name="world" type="simulation/world"/>
  <weather/>
</application>)"),
              ::testing::StartsWith("app.xml:2:17: error: /demo: no plugin 'simulatoin' in "));
  EXPECT_EQ(workshop.diagnostics.errors().size(), 1u) << workshop.diagnostics.ToString();
}

TEST(ApplicationErrors, OfAPluginAreTheOnlyOnesOfWhatItWouldHaveBrought) {
  Workshop workshop;
  EXPECT_THAT(workshop.Errors(R"(<application name="demo">
  <load plugin="simulatoin"/>
  <group name="robot">
    <port name="scan" direction="input"/>
    <port name="twist" direction="output"/>
    <module name="planner" type="simulation/planner"/>
    <module name="sink" type="test/sink"/>
    <connect from="scan" to="planner/scan"/>
    <connect from="planner/twist" to="twist"/>
    <connect from="planner/value" to="sink/value sink/second"/>
  </group>
  <module name="drive" type="simulation/drive"/>
  <connect from="robot/twist" to="drive/twist"/>
  <on_stale input="robot/sink/value" after="1s"><quit module="robot/sink"/></on_stale>
</application>)"),
              ::testing::StartsWith("app.xml:2:17: error: /demo: no plugin 'simulatoin' in "));
  EXPECT_EQ(workshop.diagnostics.errors().size(), 1u) << workshop.diagnostics.ToString();
}

TEST(ApplicationErrors, NameTheModuleTypesThatEndAlike) {
  Workshop workshop;
  workshop.Add<Source>("other/source");
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="laboratory/source"/>
  <module name="b" type="sink"/>
  <module name="c" type="somewhere/wheel"/>
  <module name="d" type="source"/>
</application>)"),
            "app.xml:2:26: error: /demo/a: there is no module type 'laboratory/source'; did you "
            "mean 'other/source' or 'test/source'?\n"
            "app.xml:3:26: error: /demo/b: there is no module type 'sink'; did you mean "
            "'test/sink'?\n"
            "app.xml:4:26: error: /demo/c: there is no module type 'somewhere/wheel'; load the "
            "plugin that brings it; `runnel modules` lists all types\n"
            "app.xml:5:26: error: /demo/d: there is no module type 'source'; did you mean "
            "'other/source' or 'test/source'?\n");
}

}  // namespace
}  // namespace runnel::testing
