// Ports and parameters that follow from static parameters, and outputs that set parameters.

#include <chrono>
#include <deque>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/parameters/configuration_saver.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

class Adder final : public Module {
 public:
  using Module::Module;
  StaticParameter<std::uint32_t> count{this, "count", {.default_value = 1, .bounds = {0, 8}}};
  std::deque<Input<double>> inputs;
  std::deque<Parameter<double>> weights;
  Output<double> sum{this, "sum"};

 private:
  Result<void> Construct() override {
    if (count.Get() == 7) return Error{.message = "seven is not to be had"};
    for (std::uint32_t i = 1; i <= count.Get(); ++i) {
      inputs.emplace_back(this, "in" + std::to_string(i));
      weights.emplace_back(this, "weight" + std::to_string(i), ParameterOptions<double>{.bounds = {0.0, 9.0}});
    }
    return {};
  }
  void Update() override {}
};

class ConstructedPorts : public ::testing::Test {
 protected:
  ConstructedPorts() { workshop_.Add<Adder>("test/adder"); }

  static std::string With(const std::string& parameter) {
    return R"(<application name="demo">
      <connect from="group/out" to="adder/in3"/>
      <module name="source" type="test/source"/>
      <module name="adder" type="test/adder"><parameter name="count" )" +
           parameter + R"(/></module>
      <group name="group">
        <port name="out" direction="output"/>
        <module name="inner" type="test/adder"/>
        <connect from="inner/sum" to="out"/>
      </group>
      <connect from="source/value" to="adder/in1 group/inner/in1"/>
    </application>)";
  }
  SavingWorkshop workshop_;
};

TEST_F(ConstructedPorts, AreThereWhenPortsAreConnected) {
  ASSERT_TRUE(workshop_.Build(With("value=\"3\""))) << workshop_.diagnostics.ToString();
  auto& adder = workshop_.Get<Adder>("/demo/adder");
  ASSERT_THAT(adder.inputs, SizeIs(3));
  EXPECT_THAT(adder.inputs[0].Sources(), SizeIs(1));
  EXPECT_THAT(adder.inputs[1].Sources(), SizeIs(0));
  EXPECT_THAT(adder.inputs[2].Sources(), SizeIs(1));
}

TEST_F(ConstructedPorts, FollowFromTheCommandLineToo) {
  ASSERT_TRUE(workshop_.configuration.AddArgument("inputs=5"));
  ASSERT_TRUE(workshop_.Build(With("value=\"3\" command_line=\"inputs\"")));
  EXPECT_THAT(workshop_.Get<Adder>("/demo/adder").inputs, SizeIs(5));
}

TEST_F(ConstructedPorts, OfAWrongNumberAreNotAskedForTwice) {
  const std::string few = workshop_.Errors(With("value=\"2\""));
  EXPECT_THAT(few, HasSubstr("there is no 'in3' in /demo/adder; did you mean 'in1'?"));
  for (const char* wrong : {"many", "9", "7"}) {
    const std::string told = workshop_.Errors(With("value=\"" + std::string(wrong) + "\""));
    EXPECT_THAT(told, HasSubstr(wrong == std::string("7") ? "seven is not" : wrong));
    EXPECT_EQ(workshop_.diagnostics.errors().size(), 1u) << told;
  }
}

TEST_F(ConstructedPorts, FollowFromTheParameterOfAPart) {
  const std::string file = ::testing::TempDir() + "runnel_constructed_part.xml";
  std::ofstream(file) << R"(<group_type>
    <parameter name="size"/>
    <module name="adder" type="test/adder"><parameter name="count" from="size"/></module>
  </group_type>)";
  EXPECT_TRUE(workshop_.Build(R"(<application name="demo">
    <group name="a" type=")" + file +
                              R"("><parameter name="size" value="4"/></group>
    <connect from="a/adder/sum" to="a/adder/in4"/>
  </application>)"))
      << workshop_.diagnostics.ToString();
  std::filesystem::remove(file);
}

constexpr const char* kWeighted = R"(<application name="demo">
  <group name="group" config="/car">
    <parameter name="all" to="adder/weight1 adder/weight2" value="4"/>
    <module name="adder" type="test/adder">
      <parameter name="weight3" value="2"/>
      <parameter name="count" value="3"/>
    </module>
  </group>
  <module name="adder" type="test/adder">
    <parameter name="weight1" value="2" command_line="weight"/>
  </module>
</application>
)";

TEST_F(ConstructedPorts, ParametersThatModulesMakeWithThemAreSet) {
  ASSERT_TRUE(workshop_.configuration.AddArgument("weight=6"));
  ASSERT_TRUE(workshop_.Build(kWeighted)) << workshop_.diagnostics.ToString();
  const auto& adder = workshop_.Get<Adder>("/demo/group/adder");
  EXPECT_EQ(adder.weights[0].Get(), 4) << "by the group's parameter";
  EXPECT_EQ(adder.weights[1].Get(), 4);
  EXPECT_EQ(adder.weights[2].Get(), 2);
  EXPECT_EQ(workshop_.Get<Adder>("/demo/adder").weights[0].Get(), 6) << "by the command line";
}

TEST_F(ConstructedPorts, ParametersThatModulesMakeWithThemAreOfTheConfiguration) {
  const TestFolder folder;
  WriteAll(folder / "car.xml", R"(<configuration><section name="car"><section name="adder">
    <value name="weight3">5</value></section></section></configuration>)");
  Diagnostics diagnostics;
  workshop_.configuration.Load(folder / "car.xml", diagnostics);
  ASSERT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  ASSERT_TRUE(workshop_.Build(kWeighted)) << workshop_.diagnostics.ToString();
  EXPECT_EQ(workshop_.Get<Adder>("/demo/group/adder").weights[2].Get(), 5);
}

TEST_F(ConstructedPorts, ParametersThatNoModuleMakesAreErrors) {
  const auto errors = [&](const std::string& inside) {
    return workshop_.Errors("<application name=\"demo\">\n<module name=\"adder\" type=\"test/adder\">\n" + inside +
                            "</module></application>");
  };
  EXPECT_THAT(errors("<parameter name=\"weigth1\" value=\"2\"/>"),
              HasSubstr("app.xml:3:18: error: /demo/adder: there is no parameter 'weigth1'; did you mean 'weight1'?"));
  EXPECT_THAT(errors("<parameter name=\"weight1\" value=\"12\"/>"), HasSubstr("app.xml:3:34: error: "));
  const std::string broken = errors("<parameter name=\"count\" value=\"7\"/><parameter name=\"weight1\" value=\"2\"/>");
  EXPECT_THAT(broken, HasSubstr("seven is not to be had"));
  EXPECT_EQ(workshop_.diagnostics.errors().size(), 1u) << broken;
}

TEST_F(ConstructedPorts, ParametersThatModulesMakeWithThemAreSaved) {
  const TestFolder folder;
  WriteAll(folder / "app.xml", kWeighted);
  FrameworkElement* const application = workshop_.Load(folder / "app.xml");
  ASSERT_NE(application, nullptr);
  EXPECT_EQ(workshop_.Text(*application, folder.path()), kWeighted);
  StructureEditor editor(workshop_.runtime, workshop_.plugins.modules(), nullptr);
  ASSERT_TRUE(editor.Apply({SetParameter{"/demo/group/adder/weight3", "7"}, SetParameter{"/demo/adder/count", "2"},
                            SetParameter{"/demo/adder/weight2", "8"}}));
  const auto saved = SaveApplication(application->runtime(), *application, workshop_.tools());
  ASSERT_TRUE(saved) << saved.error().ToString();
  SavingWorkshop again;
  again.Add<Adder>("test/adder");
  ASSERT_TRUE(again.Load(folder / "app.xml"));
  EXPECT_EQ(again.Get<Adder>("/demo/group/adder").weights[2].Get(), 7);
  EXPECT_EQ(again.Get<Adder>("/demo/group/adder").weights[0].Get(), 4);
  EXPECT_EQ(again.Get<Adder>("/demo/adder").weights[0].Get(), 2);
  EXPECT_EQ(again.Get<Adder>("/demo/adder").weights[1].Get(), 8);
}

TEST_F(ConstructedPorts, AnOutputMaySetAParameter) {
  ASSERT_TRUE(workshop_.Build(R"(<application name="demo">
    <module name="source" type="test/source"/><module name="other" type="test/source"/>
    <connect from="source/value" to="other/gain"/>
  </application>)"))
      << workshop_.diagnostics.ToString();
  const auto& feeds = workshop_.Get<Port>("/demo/source/output/value").outgoing();
  ASSERT_THAT(feeds, SizeIs(1));
  EXPECT_EQ(feeds[0].to->path(), "/demo/other/parameter/gain/feed/gain");
  EXPECT_THAT(workshop_.Errors(R"(<application name="more">
    <module name="source" type="test/source"/><module name="other" type="test/source"/>
    <connect from="source/label" to="other/gain"/>
    <connect from="source/label" to="other/text"/>
  </application>)"),
              ::testing::AllOf(HasSubstr("carries string, but"), HasSubstr("is a parameter that no output can set")));
}

constexpr const char* kFedByOutput = R"(<application name="demo" thread="control">
  <thread name="control" period="10ms"/>
  <clock type="simulated" speed="0"/>
  <module name="source" type="test/source"/>
  <module name="other" type="test/source">
    <parameter name="gain" value="2"/>
  </module>
  <group name="group">
    <parameter name="all" to="inner/gain" value="5"/>
    <module name="inner" type="test/source"/>
  </group>
  <module name="plain" type="test/source"/>
  <connect from="source/value" to="other/gain group/inner/gain plain/gain"/>
</application>
)";

TEST_F(ConstructedPorts, WhatAnOutputHasSetIsSavedOnlyWhenNothingSetsItAnyMore) {
  const TestFolder folder;
  WriteAll(folder / "app.xml", kFedByOutput);
  FrameworkElement* const application = workshop_.Load(folder / "app.xml");
  ASSERT_NE(application, nullptr);
  Scheduler scheduler(workshop_.runtime, SchedulerOptionsOf(*application));
  auto& source = workshop_.Get<Source>("/demo/source");
  auto& other = workshop_.Get<Source>("/demo/other");
  auto publish = [&, end = 0](double value) mutable {
    source.value.Publish(value);
    EXPECT_TRUE(scheduler.RunUntil(Time(std::chrono::milliseconds(end += 20))));
    EXPECT_EQ(other.gain.Get(), value);
  };
  for (const double value : {3.0, 4.0}) {
    publish(value);
    EXPECT_EQ(workshop_.Text(*application, folder.path()), kFedByOutput) << "the same text whatever has come";
  }
  ASSERT_TRUE(SaveApplication(application->runtime(), *application, workshop_.tools()));
  ASSERT_TRUE(other.gain.Set(7));
  EXPECT_THAT(workshop_.Text(*application, folder.path()), HasSubstr("name=\"gain\" value=\"7\"")) << "by hand";
  publish(6);
  ASSERT_TRUE(Port::Disconnect(source.value, workshop_.Get<Port>("/demo/other/parameter/gain/feed/gain")));
  EXPECT_THAT(workshop_.Text(*application, folder.path()), HasSubstr("name=\"gain\" value=\"6\""));
}

}  // namespace
}  // namespace runnel::testing
