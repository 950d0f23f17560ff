// What is said of wrong connections and interface ports.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

TEST(ConnectionErrors, NameTheNearestPortOfTheRightDirection) {
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

TEST(ConnectionErrors, NameTheNearestModuleInAPath) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="source" type="test/source"/>
  <module name="sink" type="test/sink"/>
  <connect from="sorce/value" to="sink/value"/>
</application>)"),
            "app.xml:4:18: error: /demo: there is no 'sorce' in /demo; did you mean 'source'?\n");
}

TEST(ConnectionErrors, NameThePlaceWithinAListOfPaths) {
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

TEST(ConnectionErrors, TellWhichPortsTakeAType) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/label" to="b/value"/>
</application>)"),
            "app.xml:4:31: error: /demo/a/output/label: carries string, but /demo/b/input/value "
            "takes double; string is taken by 'label'\n");
}

TEST(ConnectionErrors, TellWhatWouldFitAWrongPair) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/value.x" to="b/value"/>
  <connect from="a/label" to="b/value" convert="pars"/>
</application>)"),
            "app.xml:4:18: error: /demo/a/output/value: carries double, but /demo/b/input/value "
            "takes double: double has no fields\n"
            "app.xml:5:31: error: /demo/a/output/label: carries string, but /demo/b/input/value "
            "takes double: a string does not become a double by 'pars'; did you mean 'parse'?\n");
}

TEST(ConnectionErrors, EndsThatComeLaterAreNone) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="f" type="test/filter"/>
  <module name="source" type="test/source"/>
  <connect from="driver/value" to="f/value" when="present"/>
  <connect from="source/label" to="f/value" when="present" convert="pars"/>
</application>)"),
            "app.xml:5:36: error: /demo/source/output/label: carries string, but "
            "/demo/f/input/value takes double: a string does not become a double by 'pars'; did "
            "you mean 'parse'?\n");
}

TEST(ConnectionErrors, TellWrongDirections) {
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

TEST(ConnectionErrors, TellThatAModuleIsNoPort) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a" to="b/value"/>
</application>)"),
            "app.xml:4:18: error: /demo: /demo/a is not a port; write one of its ports after it, "
            "like 'value'\n");
}

TEST(ConnectionErrors, TellOfAConnectionThatIsThereAlready) {
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

TEST(ConnectionErrors, PullOnlyWithoutAQueueAndFromAProvider) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/value" to="b/value" queue="2" pull="true"/>
  <connect from="a/value" to="b/second" pull="true"/>
</application>)"),
            "app.xml:4:50: error: /demo: a connection that pulls cannot have a queue; what is pulled "
            "is the newest value; leave out one of the two\n"
            "app.xml:5:18: error: /demo/a/output/value: cannot be pulled: it has no provider; its "
            "module has to make it pullable and to set a provider\n");
}

TEST(ConnectionErrors, WantAQueueWhereItIsSaidWhatAFullOneDoes) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/value" to="b/value" on_full="refuse"/>
  <connect from="a/value" to="b/second" queue="-1" on_full="refuses"/>
  <connect from="a/label" to="b/label" on_full="refuses"/>
</application>)"),
            "app.xml:4:40: error: /demo: on_full has no meaning without a queue; add queue=\"…\" "
            "with a count above 0, or leave out on_full\n"
            "app.xml:5:48: error: /demo: '-1' is not a count; write 0, 1, 2 …\n"
            "app.xml:6:49: error: /demo: 'refuses' is not possible for on_full; did you mean "
            "'refuse'?\n");
}

TEST(ConnectionErrors, WantRequiredInputsConnected) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="filter" type="test/filter"/>
  <module name="a" type="test/source"/>
</application>)"),
            "app.xml:2:3: error: /demo/filter/input/value: nothing is connected to this input, "
            "which its module requires; connect it to an output of type double, like "
            "/demo/filter/output/value, /demo/a/output/value\n");
}

TEST(ConnectionErrors, WantInterfacesInFrontOfRequiredInputsConnected) {
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

TEST(ConnectionErrors, TellThatATypeCannotBeGuessed) {
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

constexpr const char* kDirections = R"(<application name="demo">
  <group name="inner">
    <port name="value" direction="DIRECTION"/>
    <module name="a" type="test/source"/>
    <connect from="a/value" to="value"/>
  </group>
  <module name="sink" type="test/sink"/>
  <connect from="inner/value" to="sink/value sink/second"/>
</application>)";

std::string WithDirection(const std::string& direction) {
  Workshop workshop;
  std::string text = kDirections;
  text.replace(text.find("DIRECTION"), 9, direction);
  return workshop.Errors(text);
}

TEST(ConnectionErrors, TellThatAnInterfacePortIsUsedTheWrongWayRound) {
  EXPECT_EQ(WithDirection("output"), "");
  EXPECT_EQ(WithDirection("input"),
            "app.xml:5:33: error: /demo/inner/value: is an input of its group: it sends inside of "
            "the group and receives outside; write direction=\"output\" at its <port>, or swap "
            "'from' and 'to'\n");
}

TEST(ConnectionErrors, LetInterfacePortsPassThroughTheirGroupAndBack) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <group name="outer">
    <port name="in" direction="input" type="double"/>
    <port name="out" direction="output" type="double"/>
    <group name="inner">
      <port name="in" direction="input" type="double"/>
      <port name="out" direction="output" type="double"/>
      <connect from="in" to="out"/>
    </group>
    <connect from="in" to="inner/in"/>
    <connect from="inner/out" to="out"/>
  </group>
  <module name="sink" type="test/sink"/>
  <connect from="a/value" to="outer/in"/>
  <connect from="outer/out" to="sink/value"/>
</application>)"),
            "");
  EXPECT_THAT(workshop.Errors(R"(<application name="other">
  <group name="inner">
    <port name="one" direction="output" type="double"/>
    <port name="two" direction="output" type="double"/>
    <connect from="one" to="two"/>
  </group>
</application>)"),
              HasSubstr("app.xml:5:20: error: /other/inner/one: is an output of its group"));
}

TEST(ConnectionErrors, BoundTheLengthOfQueues) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/value" to="b/value" queue="99999999999"/>
</application>)"),
            "app.xml:4:47: error: /demo: a queue of 99999999999 values is too long; its memory is "
            "taken at once; at most 1000000 values may wait\n");
}

TEST(ConnectionErrors, TellThatAConnectionHasOneSource) {
  Workshop workshop;
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/sink"/>
  <connect from="a/value a/value" to="b/value"/>
</application>)"),
            "app.xml:4:26: error: /demo: a connection comes from one port; write a <connect> for "
            "each\n");
}

}  // namespace
}  // namespace runnel::testing
