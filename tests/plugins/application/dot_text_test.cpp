// What is drawn of an application.

#include "plugins/application/dot_text.h"

#include <gmock/gmock.h>

#include "plugins/application_tags/run_description.h"
#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Dot(const std::string& text) {
  Workshop shop;
  FrameworkElement* const application = shop.Build(text);
  return application != nullptr ? DotText(*application) : shop.diagnostics.ToString();
}

TEST(DotText, DrawsGroupsInOneAnotherModulesAndConnections) {
  const std::string dot = Dot(R"(<application name="demo">
  <group name="outer">
    <group name="inner">
      <port name="out" direction="output"/>
      <module name="source" type="test/source"/>
      <connect from="source/value" to="out"/>
    </group>
    <module name="sink" type="test/sink"/>
    <connect from="inner/out" to="sink/second" queue="7"/>
  </group>
</application>)");
  EXPECT_THAT(dot, ContainsRegex("subgraph \"cluster_/demo/outer\" \\{\n *label=\"outer\"\n *"
                                 "subgraph \"cluster_/demo/outer/inner\" \\{"));
  EXPECT_THAT(dot, HasSubstr("<b>source</b><br/><font point-size=\"9\">test/source</font>"));
  EXPECT_THAT(dot, HasSubstr("-> \"/demo/outer/inner/out\":w"));
  EXPECT_THAT(dot, ContainsRegex("\"/demo/outer/inner/out\":e -> \"/demo/outer/sink\":p[0-9]+:w "
                                 "\\[.*label=\"queue 7\""));
  EXPECT_THAT(dot, Not(HasSubstr(">label<")));  // not connected
}

TEST(DotText, GivesEachThreadAColourAndSaysWhichItIs) {
  const std::string dot = Dot(R"(<application name="demo" thread="a">
  <thread name="a" period="50ms"/>
  <thread name="b" activation="trigger"/>
  <thread name="idle" period="1s"/>
  <module name="one" type="test/source"/>
  <module name="two" type="test/source" thread="b"/>
</application>)");
  EXPECT_THAT(dot, HasSubstr("a (every 50ms)"));
  EXPECT_THAT(dot, HasSubstr("b (when data comes)"));
  EXPECT_THAT(dot, Not(HasSubstr("idle")));
  const auto colour = [&](const std::string& module) {
    const std::size_t name = dot.find("<b>" + module + "</b>");
    const std::size_t place = dot.rfind("bgcolor=\"", name) + 9;
    return dot.substr(place, 7);
  };
  EXPECT_NE(colour("one"), colour("two"));
}

TEST(DotText, IsTheSameForTheSameApplication) {
  const std::string text =
      "<application name=\"demo\"><module name=\"a\" type=\"test/source\"/>"
      "<group name=\"empty\"/></application>";
  EXPECT_EQ(Dot(text), Dot(text));
}

}  // namespace
}  // namespace runnel::testing
