// What files of FINROC become, and what is told of the rest.

#include "plugins/finroc_files/finroc_application.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "core/paths/late_connections.h"
#include "core/port/proxy_port.h"
#include "plugins/application_files/saving/application_saver.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/scheduling/thread_container.h"
#include "tests/plugins/application_files/reading/test_application.h"
#include "tests/plugins/application_files/saving/application_text.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

class FinrocApplication : public ::testing::Test {
 protected:
  FinrocApplication() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~FinrocApplication() override { std::filesystem::remove_all(folder_); }

  FrameworkElement* Build(const std::string& text) {
    const auto document = XmlDocument::Parse(text, "robot.finroc");
    if (!document) {
      said_ = document.error().ToString();
      return nullptr;
    }
    EXPECT_TRUE(IsFinrocFile(document->root()));
    const BuildOutcome outcome =
        BuildFinrocApplication(*document, folder_ / "robot.finroc",
                               {shop_.runtime, shop_.plugins, shop_.tags, shop_.configuration}, BuildMode::kRun);
    said_ = outcome.diagnostics.ToString();
    return outcome.application;
  }

  std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) / "finroc_application_test" /
                                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
  Workshop shop_;
  std::string said_;
};

TEST_F(FinrocApplication, OfTenTimesTenTimesTenGroupsComesToAnEnd) {
  const auto ten_of = [](const std::string& file) {
    std::string text = "<FinstructableGroup>\n";
    for (int i = 0; i < 10; ++i) {
      text += "<element name=\"g" + std::to_string(i) +
              "\" group=\"finroc_plugins_structure\" type=\"Group\"><parameters><parameter "
              "name=\"XML file\">" +
              file + "</parameter></parameters></element>\n";
    }
    return text + "</FinstructableGroup>";
  };
  for (int i = 1; i < 8; ++i) {
    std::ofstream(folder_ / (std::to_string(i) + ".xml")) << ten_of(std::to_string(i + 1) + ".xml");
  }
  std::ofstream(folder_ / "8.xml") << "<FinstructableGroup/>";
  EXPECT_EQ(Build(ten_of("1.xml")), nullptr);
  EXPECT_THAT(said_, HasSubstr("error: "));
  EXPECT_THAT(said_, HasSubstr("the application has more than 10000 groups with a file"));
  EXPECT_EQ(shop_.runtime.root().children().size(), 0U);
}

TEST_F(FinrocApplication, BecomesModulesConnectionsAndValues) {
  std::ofstream(folder_ / "inner.xml") << R"(<FinstructableGroup>
  <interface name="Sensor Output"><port name="Loud Value" type="double"/></interface>
  <element name="The Source" group="finroc_projects_test" type="Source">
    <parameters><parameter name="Text">a text</parameter>
      <parameter name="File">maps/hall.yaml</parameter></parameters>
  </element>
  <edge src="The Source/Sensor Output/Value" dest="Sensor Output/Loud Value"/>
  <parameter link="The Source/Parameters/Count" default="8"/>
</FinstructableGroup>)";
  ASSERT_TRUE(shop_.configuration.AddArgument("front-gain=4"));
  FrameworkElement* const application = Build(R"(<?xml version="1.0" encoding="UTF-8"?>
<Finstructable defaultname="My Robot">
  <element name="Fast" group="finroc_plugins_structure" type="ThreadContainer">
    <parameters><parameter name="Cycle Time">20 ms</parameter></parameters>
    <element name="Inner Group" group="finroc_plugins_structure" type="Group">
      <parameters><parameter name="XML file">projects/robot/inner.xml</parameter></parameters>
    </element>
    <element name="Sink" group="finroc_projects_test" type="Sink"/>
  </element>
  <edge src="Fast/Inner Group/Sensor Output/Loud%20Value" dest="Fast/Sink/Input/Value"/>
  <parameter link="Fast/Inner Group/The Source/Parameters/Gain" config="/gain" cmdline="front-gain"/>
</Finstructable>)");
  ASSERT_NE(application, nullptr) << said_;
  EXPECT_EQ(said_, "");
  EXPECT_EQ(application->path(), "/my_robot");
  auto& source = shop_.Get<Source>("/my_robot/fast/inner_group/the_source");
  EXPECT_EQ(source.file.Get().text, (folder_ / "maps/hall.yaml").string());
  auto& sink = shop_.Get<Sink>("/my_robot/fast/sink");
  EXPECT_EQ(source.count.Get(), 8);
  EXPECT_EQ(source.gain.Get(), 4);
  EXPECT_EQ(source.text.Get(), "a text");
  source.value.Publish(2.5);
  EXPECT_EQ(*sink.value.Read(), 2.5);
  const auto& thread = shop_.Get<ThreadContainer>("/my_robot/threads/fast");
  EXPECT_EQ(thread.options().period, std::chrono::milliseconds(20));
  EXPECT_EQ(AssignedThread(source), thread.id());
}

TEST_F(FinrocApplication, TellsOfEachThatHasNoCounterpart) {
  FrameworkElement* const application = Build(R"(<Finstructable defaultname="robot"
    dependencies="finroc_projects_test, finroc_projects_other, finroc_plugins_structure">
  <interface name="Output"><port name="x" type="double"/></interface>
  <element name="A" group="finroc_projects_test" type="Source">
    <parameters><parameter name="Txt">t</parameter></parameters>
  </element>
  <element name="B" group="finroc_projects_test" type="Snk"/>
  <element name="C" group="finroc_projects_test" type="Sink"/>
  <edge src="A/Output/Value" dest="B/Input/Value"/>
  <edge src="A/Output/Value" dest="C/Input/Value"><conversion operation="For Each"/></edge>
  <edge src="A/Output/Label" dest="C/Input/Second"/>
  <parameter link="A/Parameters/Gian" default="2"/>
  <unknown/>
</Finstructable>)");
  ASSERT_NE(application, nullptr) << said_;
  for (const char* expected : {
           "robot.finroc:2:19: warning: /robot: there is no plugin 'other'",
           "robot.finroc:3:3: warning: /robot: an application has no interface",
           "robot.finroc:5:17: warning: /robot/a: there is no parameter 'txt'; did you mean "
           "'text'?",
           "robot.finroc:7:3: warning: /robot: there is no module type 'test/snk' for 'B'; did you "
           "mean 'test/sink'?",
           "robot.finroc:9:36: warning: /robot: there is no port 'b/input/value'",
           "robot.finroc:10:51: warning: /robot: the conversion 'For Each' of an edge has no counterpart",
           "robot.finroc:11:3: warning",
           "robot.finroc:12:3: warning: /robot: there is no parameter 'a/gian'; did you "
           "mean 'gain'?",
           "robot.finroc:13:3: warning: /robot: <unknown> has no counterpart",
       }) {
    EXPECT_THAT(said_, HasSubstr(expected));
  }
  EXPECT_EQ(shop_.Get<Port>("/robot/c/input/value").Sources().size(), 1u);
  EXPECT_EQ(shop_.Get<ThreadContainer>("/robot/threads/main").options().period, std::chrono::milliseconds(40));
}

TEST_F(FinrocApplication, TakesValuesAsNewerVersionsNestThem) {
  const std::filesystem::path configuration = folder_ / "robot.xml";
  std::ofstream(configuration) << R"(<?xml version="1.0" encoding="UTF-8"?>
<root>
  <value name="noiselevel">15 cm</value>
  <node name="some element"><value name="count">7</value></node>
</root>)";
  Diagnostics read;
  shop_.configuration.Load(configuration, read);
  ASSERT_TRUE(read.ok()) << read.ToString();
  FrameworkElement* const application = Build(R"(<Finstructable defaultname="robot">
  <element name="Outer" group="finroc_plugins_structure" type="Group">
    <element name="A Source" group="finroc_projects_test" type="Source"/>
  </element>
  <element name="B" group="finroc_projects_test" type="Source"/>
  <parameter_links>
    <element name="Outer">
      <element name="A Source">
        <parameter name="Gain" config="/noiselevel" default="2"/>
        <parameter name="Count" config="/some element/count"/>
      </element>
    </element>
    <element name="B"><parameter name="Gain" default="300 mm"/></element>
    <element name="Gone"><parameter name="Gain" default="1"/></element>
    <other/>
  </parameter_links>
</Finstructable>)");
  ASSERT_NE(application, nullptr) << said_;
  auto& source = shop_.Get<Source>("/robot/outer/a_source");
  EXPECT_EQ(source.gain.Get(), 0.15);
  EXPECT_EQ(source.count.Get(), 7);
  EXPECT_EQ(shop_.Get<Source>("/robot/b").gain.Get(), 0.3);
  EXPECT_THAT(said_, HasSubstr("robot.finroc:14:26: warning: /robot: there is no parameter "
                               "'gone/gain'"));
  EXPECT_THAT(said_, HasSubstr("robot.finroc:15:5: warning: /robot: <other> has no counterpart"));
}

TEST_F(FinrocApplication, TellsOfEdgesToOtherProcessesAndOfFlags) {
  FrameworkElement* const application = Build(R"(<Finstructable defaultname="robot">
  <element name="A" group="finroc_projects_test" type="Source"/>
  <element name="B" group="finroc_projects_test" type="Sink"/>
  <edge src="tcp:other-host:4444/Robot/X" dest="B/Input/Value"/>
  <edge src="A/Output/Value" dest="tcp:/Robot/Y" flags="Reconnect"/>
  <edge src="A/Output/Value" dest="B/Input/Second" flags="Optional"/>
  <edge src="C/Output/Value" dest="B/Input/Label" flags="Reconnect" comment="later"><conversion operation="ToString"/></edge>
  <edge src="A/Output/Value" dest="B/Input/Label" flags="Compressed"><conversion operation="ToString"/></edge>
</Finstructable>)");
  ASSERT_NE(application, nullptr) << said_;
  for (const char* expected :
       {"robot.finroc:4:14: warning: /robot: 'tcp:other-host:4444/Robot/X' is a port of another "
        "process",
        "robot.finroc:5:36: warning: /robot: 'tcp:/Robot/Y' is a port of another process",
        "robot.finroc:8:51: warning: /robot: 'flags' of an edge has no counterpart: 'Compressed'"}) {
    EXPECT_THAT(said_, HasSubstr(expected));
  }
  EXPECT_EQ(shop_.Get<Port>("/robot/b/input/second").Sources().size(), 1u);
  EXPECT_EQ(shop_.Get<Port>("/robot/b/input/label").Sources().size(), 1u) << "as a text";
  ASSERT_EQ(LateConnections::Of(shop_.runtime).all().size(), 2u);
  EXPECT_TRUE(LateConnections::Of(shop_.runtime).all()[1].waits_for) << "whatever attributes follow its flags";
  EXPECT_TRUE(shop_.Get<Port>("/robot/b/input/value").Sources().empty());
}

TEST_F(FinrocApplication, KeepsFlagsOfEdgesWhateverAttributesStandBesideThem) {
  FrameworkElement* const application = Build(R"(<Finstructable defaultname="robot">
  <element name="A" group="finroc_projects_test" type="Source"/>
  <element name="B" group="finroc_projects_test" type="Sink"/>
  <edge comment="before" src="A/Output/Value" dest="B/Input/Value" flags="Optional" more="behind"/>
  <edge src="A/Output/Value" dest="B/Input/Second" flags="SchedulingNeutral" comment="behind"/>
  <edge src="A/Output/Value" dest="B/Input/Label" flags="Reconnect|SchedulingNeutral" comment="behind"><conversion operation="ToString"/></edge>
</Finstructable>)");
  ASSERT_NE(application, nullptr) << said_;
  const auto& source = shop_.Get<Port>("/robot/a/output/value");
  const auto options = [&](const std::string& input) {
    const ConnectOptions found = source.OptionsTo(shop_.Get<Port>("/robot/b/input/" + input));
    return std::pair(found.when_present, found.late);
  };
  EXPECT_EQ(options("value"), std::pair(true, false));
  EXPECT_EQ(options("second"), std::pair(false, true));
  EXPECT_EQ(options("label"), std::pair(true, true));
}

TEST_F(FinrocApplication, WarnsOfInputsThatNothingFeedsAnyMore) {
  ASSERT_NE(Build(R"(<Finstructable>
  <element name="A" group="finroc_projects_test" type="Filter"/>
</Finstructable>)"),
            nullptr);
  EXPECT_THAT(said_, HasSubstr("robot.finroc:2:3: warning: /robot/a/input/value: nothing is "
                               "connected"));
}

TEST_F(FinrocApplication, ConnectsNothingAgainstTheDirectionOfAGroup) {
  std::ofstream(folder_ / "inner.xml") << R"(<FinstructableGroup>
  <interface name="Sensor Output"><port name="Loud Value" type="double"/></interface>
  <element name="The Source" group="finroc_projects_test" type="Source"/>
  <edge src="The Source/Sensor Output/Value" dest="Sensor Output/Loud Value"/>
</FinstructableGroup>)";
  ASSERT_NE(Build(R"(<Finstructable defaultname="robot">
  <element name="A" group="finroc_projects_test" type="Source"/>
  <element name="Inner" group="finroc_plugins_structure" type="Group">
    <parameters><parameter name="XML file">inner.xml</parameter></parameters>
  </element>
  <edge src="A/Output/Value" dest="Inner/Loud Value"/>
</Finstructable>)"),
            nullptr)
      << said_;
  EXPECT_THAT(said_, HasSubstr("robot.finroc:6:3: warning: /robot: goes against the direction"));
  EXPECT_TRUE(shop_.Get<Port>("/robot/a/output/value").outgoing().empty());
}

TEST_F(FinrocApplication, IsLeftOutWholeIfSomethingIsWrong) {
  EXPECT_EQ(Build(R"(<Finstructable>
  <element name="A" group="finroc_projects_test" type="Unready"/>
</Finstructable>)"),
            nullptr);
  EXPECT_THAT(said_, HasSubstr("robot.finroc:2:3: error: /robot/a: the file is not there"));
  EXPECT_TRUE(shop_.runtime.root().children().empty());
}

TEST_F(FinrocApplication, ThatContainsItselfComesToAnEnd) {
  std::ofstream(folder_ / "inner.xml") << R"(<Finstructable>
  <element name="G" group="finroc_plugins_structure" type="Group">
    <parameters><parameter name="XML file">inner.xml</parameter></parameters>
  </element></Finstructable>)";
  ASSERT_NE(Build(R"(<Finstructable>
  <element name="G" group="finroc_plugins_structure" type="Group">
    <parameters><parameter name="XML file">inner.xml</parameter></parameters>
  </element></Finstructable>)"),
            nullptr);
  EXPECT_THAT(said_, HasSubstr("contains itself"));
}

TEST_F(FinrocApplication, IsSavedAsOneOfRunnel) {
  FrameworkElement* const application = Build(R"(<Finstructable defaultname="robot">
  <element name="A" group="finroc_projects_test" type="Source"/>
</Finstructable>)");
  ASSERT_NE(application, nullptr) << said_;
  const auto text = testing::ApplicationText(*application, {shop_.plugins, shop_.tags}, folder_);
  ASSERT_TRUE(text) << text.error().ToString();
  EXPECT_EQ(*text, R"(<application name="robot" thread="main">
  <thread name="main" period="40ms"/>

  <module name="a" type="test/source"/>
</application>
)");
}

}  // namespace
}  // namespace runnel::testing
