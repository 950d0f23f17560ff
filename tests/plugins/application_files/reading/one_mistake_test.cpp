// One mistake is told once, and none waits until another has been mended.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

TEST(OneMistake, IsToldOnce) {
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

// What is said of an application with a source and a filter, which needs its input, connected
// `from` to `to`; `first` stands before them.
std::string WithConnection(const std::string& connect, const std::string& first = "") {
  Workshop workshop;
  return workshop.Errors("<application name=\"demo\">\n" + first +
                         "  <module name=\"a\" type=\"test/source\"/>\n"
                         "  <module name=\"filter\" type=\"test/filter\"/>\n"
                         "  " +
                         connect + "\n</application>");
}

std::string WithSource(const std::string& source) {
  Workshop workshop;
  return workshop.Errors("<application name=\"demo\">\n  " + source +
                         "\n"
                         "  <module name=\"filter\" type=\"test/filter\"/>\n"
                         "  <connect from=\"source/value\" to=\"filter/value\"/>\n"
                         "</application>");
}

TEST(OneMistake, InATagIsNoMistakeOfItsConnections) {
  EXPECT_EQ(WithSource(R"(<modul name="source" type="test/source"/>)"),
            "app.xml:2:3: error: /demo: no <modul> may stand in <application>; did you mean "
            "'module'?\n");
  EXPECT_EQ(WithSource(R"(<machine name="source" type="test/source"/>)"),
            "app.xml:2:3: error: /demo: no <machine> may stand in <application>; there is "
            "'clock', 'connect', 'driving', 'group', 'latency', 'load', 'log', 'module', 'on_fault', 'on_pause', "
            "'on_stale', 'on_stuck' and 4 more\n");
}

TEST(OneMistake, InANameIsNoMistakeOfItsConnections) {
  EXPECT_EQ(WithSource(R"(<module nmae="source" type="test/source"/>)"),
            "app.xml:2:11: error: /demo: <module> knows no 'nmae'; did you mean 'name'?\n");
  EXPECT_EQ(WithSource(R"(<module type="test/source"/>)"),
            "app.xml:2:3: error: /demo: <module> has no 'name'; add name=\"…\"\n");
  EXPECT_EQ(WithSource(R"(<module name="the/source" type="test/source"/>)"),
            "app.xml:2:17: error: /demo: the name 'the/source' contains a '/', which separates "
            "names in paths\n");
  EXPECT_EQ(WithSource(R"(<module name="" type="test/source"/>)"),
            "app.xml:2:17: error: /demo: a name must not be empty\n");
}

TEST(OneMistake, OfAModuleWithARequiredInputIsNotThatItIsUnconnected) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module type="test/filter"/>
  <connect from="a/value" to="filter/value"/>
</application>)"),
            "app.xml:3:3: error: /demo: <module> has no 'name'; add name=\"…\"\n");
}

TEST(OneMistake, OfANameThatIsTakenIsNoneOfWhatIsMissingInTheFirst) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <group name="a"/>
  <group name="a">
    <module name="source" type="test/source"/>
  </group>
  <module name="filter" type="test/filter"/>
  <connect from="a/source/value" to="filter/value"/>
</application>)"),
            "app.xml:3:16: error: /demo/a: there is already an element called 'a' in /demo; the "
            "first is in line 2\n");
}

TEST(OneMistake, OfANameThatIsTakenIsNotThatTheRightNameIsMissing) {
  EXPECT_EQ(WithConnection(R"(<connect from="origin/value" to="filter/value"/>)",
                           "  <module name=\"a\" type=\"test/source\"/>\n"),
            "app.xml:3:17: error: /demo/a: there is already an element called 'a' in /demo; the "
            "first is in line 2\n");
}

TEST(OneMistake, InANamelessPlaceStillGetsTheNearestNameTold) {
  EXPECT_EQ(WithConnection(R"(<connect from="a/value" to="fliter/value"/>)", "<module/>\n"),
            "app.xml:2:1: error: /demo: <module> has no 'name'; add name=\"…\"\n"
            "app.xml:5:31: error: /demo: there is no 'fliter' in /demo; did you mean 'filter'?\n");
}

TEST(OneMistake, OfAConnectionIsNotThatAnInputIsUnconnected) {
  EXPECT_EQ(WithConnection(R"(<conect from="a/value" to="filter/value"/>)"),
            "app.xml:4:3: error: /demo: no <conect> may stand in <application>; did you mean "
            "'connect'?\n");
  EXPECT_EQ(WithConnection(R"(<connect form="a/value" to="filter/value"/>)"),
            "app.xml:4:12: error: /demo: <connect> knows no 'form'; did you mean 'from'?\n");
  EXPECT_EQ(WithConnection(R"(<connect from="a/value" to=""/>)"),
            "app.xml:4:31: error: /demo: a path must not be empty\n");
  EXPECT_EQ(WithConnection(R"(<connect from="a/value"/>)"),
            "app.xml:4:3: error: /demo: <connect> has no 'to'; add to=\"…\": inputs or interface "
            "ports, separated by blanks\n");
  EXPECT_EQ(WithConnection(R"(<connect to="filter/value"/>)"),
            "app.xml:4:3: error: /demo: <connect> has no 'from'; add from=\"…\": an output, or an "
            "interface port\n");
  EXPECT_EQ(WithConnection(R"(<connect from=" a/value" to="filter/value"/>)"),
            "app.xml:4:18: error: /demo: the path ' a/value' begins or ends with a blank\n");
}

TEST(OneMistake, OfTheChosenPortsIsNotThatAnInputIsUnconnected) {
  EXPECT_EQ(WithConnection(R"(<connect from="filter/input/value" to="a/value"/>)"),
            "app.xml:4:18: error: /demo/filter/input/value: is an input and cannot send; did you "
            "mean to write 'from' and 'to' the other way round?\n");
  EXPECT_EQ(WithConnection(R"(<connect from="a/value" to="filter/output/value"/>)"),
            "app.xml:4:31: error: /demo/filter/output/value: is an output and cannot receive\n");
  EXPECT_EQ(WithConnection(R"(<connect from="a/label" to="filter/value"/>)"),
            "app.xml:4:31: error: /demo/a/output/label: carries string, but "
            "/demo/filter/input/value takes double\n");
}

TEST(OneMistake, OfCommasInAListIsToldWithItsCure) {
  EXPECT_EQ(WithConnection(R"(<connect from="a/value" to="filter/value,sink/value"/>)",
                           "  <module name=\"sink\" type=\"test/sink\"/>\n"),
            "app.xml:5:31: error: /demo: a comma between paths; paths are separated by blanks\n");
}

// Paths cannot be followed without it.
TEST(Mistakes, InsideAnApplicationWithoutANameAreToldButForPaths) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application>
  <module name="x" type="test/sorce"/>
  <module name="a" type="test/source"/>
  <module name="sink" type="test/sink"/>
  <connect from="a/vlaue" to="sink/value"/>
  <connect from="/demo/a/value" to="/demo/sink/second"/>
</application>)"),
            "app.xml:1:1: error: /: <application> has no 'name'; add name=\"…\": the first part of "
            "all paths\n"
            "app.xml:2:26: error: /x: there is no module type 'test/sorce'; did you mean "
            "'test/source'?\n");
}

TEST(Mistakes, OfOneTagAreToldOneByOne) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="a" type="test/sinc"/>
</application>)"),
            "app.xml:3:26: error: /demo/a: there is no module type 'test/sinc'; did you mean "
            "'test/sink'?\n");
}

TEST(Mistakes, InsideATagThatIsWrongItselfAreAllTold) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <gruop name="inner">
    <module name="x" type="test/sorce"/>
    <module name="a" type="test/source"/>
  </gruop>
  <group name="inner">
    <module name="y" type="test/sinc"/>
  </group>
</application>)"),
            "app.xml:2:3: error: /demo: no <gruop> may stand in <application>; did you mean "
            "'group'?\n"
            "app.xml:3:28: error: /demo/x: there is no module type 'test/sorce'; did you mean "
            "'test/source'?\n"
            "app.xml:7:28: error: /demo/inner/y: there is no module type 'test/sinc'; did you "
            "mean 'test/sink'?\n");
}

TEST(Mistakes, OfThreeElementsAreThree) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source">
    <parameter name="gian" value="1"/>
  </module>
  <module name="filter" type="test/filter" colour="red"/>
  <module name="sink" type="test/sink"/>
  <group>
    <module name="inner" type="test/sinc"/>
  </group>
  <connect from="a/value" to="filter/value"/>
  <connect from="filter/value" to="sink/vlaue"/>
</application>)"),
            "app.xml:3:22: error: /demo/a: there is no parameter 'gian'; did you mean 'gain'?\n"
            "app.xml:5:44: error: /demo/filter: <module> knows no 'colour'; there is 'thread', 'config', 'tags'\n"
            "app.xml:7:3: error: /demo: <group> has no 'name'; add name=\"…\"\n"
            "app.xml:8:32: error: /demo/inner: there is no module type 'test/sinc'; did you mean "
            "'test/sink'?\n"
            "app.xml:11:36: error: /demo: there is no 'vlaue' in /demo/sink; did you mean "
            "'value'?\n");
}

}  // namespace
}  // namespace runnel::testing
