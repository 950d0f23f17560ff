// What is said of wrong application files: place, path, cure.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/runtime_construction/test_application.h"

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

TEST(ApplicationErrors, NameTheNearestPortOfTheRightDirection) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/vlaue" to="b/value"/>
  <connect from="a/value" to="b/secnd"/>
</application>)"),
            "app.xml:4:18: error: /demo: there is no 'vlaue' in /demo/a; did you mean 'value'?\n"
            "app.xml:5:31: error: /demo: there is no 'secnd' in /demo/b; did you mean 'second'?\n");
}

TEST(ApplicationErrors, NameTheNearestModuleInAPath) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="source" type="test/source"/>
  <module name="sink" type="test/sink"/>
  <connect from="sorce/value" to="sink/value"/>
</application>)"),
            "app.xml:4:18: error: /demo: there is no 'sorce' in /demo; did you mean 'source'?\n");
}

TEST(ApplicationErrors, NameThePlaceWithinAListOfPaths) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/value" to="b/value  b/ü b/third"/>
</application>)"),
            "app.xml:4:40: error: /demo: there is no 'ü' in /demo/b; there is 'value', 'second', "
            "'label'\n"
            "app.xml:4:44: error: /demo: there is no 'third' in /demo/b; there is 'value', "
            "'second', 'label'\n");
}

TEST(ApplicationErrors, TellWhichPortsTakeAType) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/label" to="b/value"/>
</application>)"),
            "app.xml:4:31: error: /demo/a/output/label: carries string, but /demo/b/input/value "
            "takes double; string is taken by 'label'\n");
}

TEST(ApplicationErrors, TellWrongDirections) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="b/value" to="a/value"/>
  <connect from="a/value" to="a/value"/>
</application>)"),
            "app.xml:4:18: error: /demo/b/input/value: is an input and cannot send; did you mean "
            "to write 'from' and 'to' the other way round?\n"
            "app.xml:5:31: error: /demo/a/output/value: a port cannot be connected to itself\n");
}

TEST(ApplicationErrors, TellThatAModuleIsNoPort) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a" to="b/value"/>
</application>)"),
            "app.xml:4:18: error: /demo: /demo/a is not a port; write one of its ports after it, "
            "like 'value'\n");
}

TEST(ApplicationErrors, TellOfAConnectionThatIsThereAlready) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/value" to="b/value"/>
  <connect from="a/value" to="b/value"/>
</application>)"),
            "app.xml:5:31: error: /demo/a/output/value: is connected to /demo/b/input/value "
            "already\n");
}

TEST(ApplicationErrors, WantAQueueWhereItIsSaidWhatAFullOneDoes) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/value" to="b/value" on_full="refuse"/>
  <connect from="a/value" to="b/second" queue="-1" on_full="refuses"/>
</application>)"),
            "app.xml:4:40: error: /demo: on_full has no meaning without a queue; add queue=\"…\" "
            "with a count above 0, or leave out on_full\n"
            "app.xml:5:48: error: /demo: '-1' is not a count; write 0, 1, 2 …\n"
            "app.xml:5:61: error: /demo: 'refuses' is not possible for on_full; did you mean "
            "'refuse'?\n");
}

TEST(ApplicationErrors, NameTheNearestTagAndAttribute) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <modul name="a" type="test/source"/>
  <module nmae="b" type="test/sink"/>
  <connect to="b/value">hello</connect>
</application>)"),
            "app.xml:2:3: error: /demo: no <modul> may stand in <application>; did you mean "
            "'module'?\n"
            "app.xml:3:3: error: /demo: <module> has no 'name'; add name=\"…\"\n"
            "app.xml:3:11: error: /demo: <module> knows no 'nmae'; did you mean 'name'?\n"
            "app.xml:4:3: error: /demo: <connect> has no 'from'; add from=\"…\"\n"
            "app.xml:4:3: error: /demo: no text may stand in <connect>; leave out 'hello'\n");
}

TEST(ApplicationErrors, TellOfTagsInTheWrongPlace) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <port name="x" direction="input" type="double"/>
</application>)"),
            "app.xml:2:3: error: /demo: no <port> may stand in <application>; there is 'connect', "
            "'group', 'load', 'module'\n");
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

TEST(ApplicationErrors, WantRequiredInputsConnected) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="filter" type="test/filter"/>
  <module name="a" type="test/source"/>
</application>)"),
            "app.xml:2:3: error: /demo/filter/input/value: nothing is connected to this input, "
            "which its module requires; connect it to an output of type double, like "
            "/demo/filter/output/value, /demo/a/output/value\n");
}

TEST(ApplicationErrors, WantInterfacesInFrontOfRequiredInputsConnected) {
  Workshop workshop;
  EXPECT_THAT(workshop.Errors(R"(<application name="demo">
  <group name="inner">
    <port name="wanted" direction="input"/>
    <module name="filter" type="test/filter"/>
    <connect from="wanted" to="filter/value"/>
  </group>
</application>)"),
              HasSubstr("app.xml:4:5: error: /demo/inner/filter/input/value: nothing is connected "
                        "to this input"));
}

TEST(ApplicationErrors, TellOneMistakeOnce) {
  Workshop workshop;
  // Neither the connections of the missing module nor the input that they would have fed are told.
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/sorce">
    <parameter name="gain" value="1"/>
  </module>
  <module name="filter" type="test/filter"/>
  <module name="sink" type="test/sink"/>
  <connect from="a/value" to="filter/value sink/value"/>
  <connect from="filter/value" to="a/b/c"/>
</application>)"),
            "app.xml:2:26: error: /demo/a: there is no module type 'test/sorce'; "
            "did you mean 'test/source'?\n");
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="filter" type="test/filter"/>
  <connect from="a/value" to="fliter/value"/>
</application>)"),
            "app.xml:4:31: error: /demo: there is no 'fliter' in /demo; did you mean "
            "'filter'?\n");
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="filter" type="test/filter"/>
  <connect from="a/value" to="filter/vlue"/>
</application>)"),
            "app.xml:4:31: error: /demo: there is no 'vlue' in /demo/filter; did you mean "
            "'value'?\n");
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <group name="inner">
    <port name="wanted" direction="input" type="doubel"/>
    <module name="filter" type="test/filter"/>
    <connect from="wanted" to="filter/value"/>
  </group>
  <connect from="a/value" to="inner/wanted"/>
</application>)"),
            "app.xml:4:49: error: /demo/inner/wanted: there is no type 'doubel'; did you mean "
            "'double'?\n");
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
  EXPECT_THAT(lines, ::testing::ElementsAre(2, 3, 4, 5, 6, 8, 9, 11, 13))
      << workshop.diagnostics.ToString();
}

TEST(ApplicationErrors, LeaveNothingHalfBuilt) {
  Workshop workshop;
  workshop.Build(
      R"(<application name="other"><module name="a" type="test/source"/></application>)");
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
  const BuildOutcome outcome = BuildApplication(
      "/no/such/file.xml",
      {workshop.runtime, workshop.plugins, workshop.tags, workshop.configuration}, BuildMode::kRun);
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("/no/such/file.xml: error: "));
}

TEST(ApplicationErrors, InsideAnApplicationWithoutANameAreToldToo) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application>
  <module name="a"/>
</application>)"),
            "app.xml:1:1: error: /: <application> has no 'name'; add name=\"…\"\n"
            "app.xml:2:3: error: /a: <module> has no 'type'; add type=\"…\"\n");
}

TEST(ApplicationErrors, TellThatATypeCannotBeGuessed) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <group name="inner">
    <port name="x" direction="outward"/>
    <port name="y" direction="output"/>
  </group>
</application>)"),
            "app.xml:3:31: error: /demo/inner/x: 'outward' is not possible for direction; there "
            "is 'input', 'output'\n"
            "app.xml:4:5: error: /demo/inner/y: the type of this port cannot be told from its "
            "connections; add type=\"…\"\n");
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

}  // namespace
}  // namespace runnel::testing
