// The inputs by which outputs set parameters: which are made, which stay, and connections that wait for them.

#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/lockfree/thread_epoch.h"
#include "core/paths/new_feeds.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/parameter_inputs_fixture.h"

namespace runnel::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(ParameterInputs, AreNotLeftByWhatIsRefused) {
  Build(std::string(kModules) + R"(
    <module name="third" type="test/source"/><module name="fourth" type="test/source"/>
    <connect from="source/value" to="other/gain"/>
    <connect from="absent/value" to="fourth/gain" when="present"/>)");
  workshop_.Errors(R"(<application name="more">
    <module name="source" type="test/source"/>
    <connect from="source/value" to="/demo/other/gain"/>
    <connect from="source/value" to="/demo/third/gain"/>
    <connect from="source/value" to="/demo/fourth/gain"/>
    <connect from="source/value" to="/demo/nowhere/gain"/>
  </application>)");
  EXPECT_TRUE(IsFed("other"));
  EXPECT_FALSE(IsFed("third"));
  EXPECT_TRUE(IsFed("fourth")) << "is waited for";
  const ConnectPorts wanted{"/demo/source/value", "/demo/third/gain"};
  EXPECT_FALSE(Apply({wanted, SetParameter{"/demo/nowhere/gain", "1"}}));
  EXPECT_FALSE(IsFed("third"));
  const auto revision = workshop_.runtime.revision();
  EXPECT_FALSE(Apply({SetParameter{"/demo/nowhere/gain", "1"}}));
  EXPECT_EQ(workshop_.runtime.revision(), revision);
  for (int round = 0; round < 2; ++round) {
    EXPECT_TRUE(Apply({wanted}));
    EXPECT_TRUE(IsFed("third"));
    EXPECT_TRUE(Apply({DisconnectPorts{"/demo/source/value", "/demo/third/gain"}}));
  }
}

// Of what has been found, by whom it has been looked for.
class Looked : public ParameterInputs {
 protected:
  Port& Find() {
    const std::lock_guard lock(workshop_.runtime.structure_mutex());
    return **PathSearch(workshop_.runtime).FindPort("/demo/other/gain", PathKind::kInput);
  }
};

TEST_F(Looked, GoesAgain) {
  Build(kModules);
  {
    const NewFeeds feeds(workshop_.runtime);
    Find();
  }
  EXPECT_FALSE(IsFed("other"));
}

// Whatever asks for it: it goes with its connections, and would take that along.
TEST_F(Looked, HasNothingOfItsOwn) {
  Build(kModules);
  ASSERT_TRUE(Apply({ConnectPorts{"/demo/source/value", "/demo/other/gain"}}));
  const std::string why =
      "/demo/other/parameter/gain/feed/gain: only passes on what is connected to the parameter "
      "/demo/other/parameter/gain";
  const double value = 2;
  InputLimits limits;
  limits.maximum = 1;
  {
    const std::lock_guard lock(workshop_.runtime.structure_mutex());
    for (const Result<void>& done :
         {PublishByHand(Find(), &value), PublishByHand(Find(), &value, Port::Setter::kRule), Find().Block(),
          Find().SetLimits(limits), Find().SetDriving(true, AnyValue(0.0), {}, DrivingKind::kVelocity)}) {
      ASSERT_FALSE(done);
      EXPECT_THAT(done.error().ToString(), HasSubstr(why));
    }
    EXPECT_EQ(internal::WhatIsSetAt(Find()), "");
  }
  EXPECT_THAT(Apply({TagElement{Find().path(), {"fast"}}}).diagnostics.ToString(), HasSubstr(why));
  EXPECT_THAT(workshop_.Errors(R"(<application name="more"><module name="other" type="test/source">
    <input name="gain" maximum="1"/></module><driving port="other/gain" safe="0" command="velocity"/>
    <on_fault of="other"><publish port="other/parameter/gain/feed/gain" value="0"/></on_fault></application>)"),
              ::testing::AllOf(HasSubstr("2:5: error: /more/other/parameter/gain/feed/gain: only passes on"),
                               HasSubstr("3:41: error: /more/other/parameter/gain/feed/gain: only passes on"),
                               HasSubstr("say it of the output that is connected to it")));
}

TEST_F(Looked, StaysForAnInterfaceThatNothingFeedsYet) {
  Build(std::string(kModules) + R"(<group name="group"><port name="out" direction="output" type="double"/></group>)");
  {
    const NewFeeds feeds(workshop_.runtime);
    ASSERT_TRUE(Port::Connect(workshop_.Get<Port>("/demo/group/out"), Find()));
  }
  EXPECT_TRUE(IsFed("other"));
}

TEST_F(Looked, StaysWhereNothingCanBeDeleted) {
  Build(kModules);
  {
    const EpochGuard cycle;
    const NewFeeds feeds(workshop_.runtime);
    Find();
  }
  EXPECT_TRUE(IsFed("other"));
}

TEST_F(Looked, AnotherRuntimesInputsAreNotIts) {
  Build(R"(<module name="sink" type="test/sink"/>)");
  SavingWorkshop other;
  {
    const NewFeeds feeds(workshop_.runtime);
    for (int i = 0; i < 20; ++i) {
      auto& source = other.runtime.Create<Source>(other.runtime.root(), "source" + std::to_string(i));
      const std::lock_guard lock(other.runtime.structure_mutex());
      ASSERT_TRUE(PathSearch(other.runtime).FindPort(source.path() + "/gain", PathKind::kInput));
    }
  }
  EXPECT_TRUE(workshop_.runtime.root().Find("/demo/sink/input/value"));
}

TEST_F(ParameterInputs, AreWaitedForUntilTheyComeAndWhenTheyAreMadeAnew) {
  Build(R"(<module name="source" type="test/source"/>
    <connect from="source/value" to="later/boost" when="present"/>)");  // a former name
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(Apply({CreateModule{"/demo/later", "test/source"}}));
    const auto connected = ElementsAre("/demo/source/output/value -> /demo/later/parameter/gain");
    EXPECT_THAT(Late(), connected) << round;
    ASSERT_TRUE(Apply({ReplaceModule{"/demo/later", "test/source"}}));
    EXPECT_THAT(Late(), connected) << round;
    ASSERT_TRUE(Apply({DeleteElement{"/demo/later"}}));
    EXPECT_THAT(Late(), ElementsAre("/demo/source/output/value -> /demo/later/parameter/gain waits")) << round;
  }
  EXPECT_TRUE(Apply({DisconnectPorts{"/demo/source/value", "/demo/later/gain"}}));
  EXPECT_THAT(Late(), IsEmpty());
}

TEST_F(ParameterInputs, AreWaitedForByPathsWithoutTheApplication) {
  Build(R"(<module name="source" type="test/source"/>)");
  ASSERT_TRUE(Apply({ConnectPorts{"source/value", "later/gain", {.when_present = true}}}));
  ASSERT_TRUE(Apply({CreateModule{"/demo/later", "test/source"}}));
  EXPECT_THAT(Late(), ElementsAre("/demo/source/output/value -> /demo/later/parameter/gain"));
  EXPECT_TRUE(Apply({DisconnectPorts{"source/value", "later/gain"}}));
  EXPECT_THAT(Late(), IsEmpty());
}

TEST_F(ParameterInputs, AreWaitedForUnderTheirNewNames) {
  Build(kModules);
  ASSERT_TRUE(Apply({ConnectPorts{"/demo/source/value", "/demo/other/gain", {.when_present = true}},
                     RenameElement{"/demo/other", "a"}}));
  ASSERT_TRUE(Apply({RenameElement{"/demo/a", "b"}, RenameElement{"/demo/b", "c"}}));
  EXPECT_THAT(Late(), ElementsAre("/demo/source/output/value -> /demo/c/parameter/gain"));
  EXPECT_TRUE(Apply({DisconnectPorts{"/demo/source/value", "/demo/c/gain"}}));
  EXPECT_THAT(Late(), IsEmpty());
}

TEST_F(ParameterInputs, AreWaitedForByWhatTakesTheirPlace) {
  Build(kModules);
  {
    const std::lock_guard lock(workshop_.runtime.structure_mutex());
    ASSERT_TRUE(LateConnections::Of(workshop_.runtime).Add("//distant/port", "/demo/other/gain", {}));
  }
  ASSERT_TRUE(Apply({ReplaceModule{"/demo/other", "test/source"}}));
  ASSERT_TRUE(Apply({SetParameter{"/demo/other/text", "static"}}));
  EXPECT_THAT(Late(), ElementsAre("//distant/port -> /demo/other/parameter/gain waits"));
}

TEST_F(ParameterInputs, AreNotInputsOfTheSameName) {
  EXPECT_THAT(workshop_.Errors(R"(<application name="demo">
    <module name="twin" type="test/twin"/>
    <connect from="absent/value" to="twin/parameter/gain" when="present"/>
  </application>)"),
              HasSubstr("/demo/twin/input/gain: nothing is connected"));
  Build(R"(<module name="source" type="test/source"/><module name="twin" type="test/twin"/>
    <connect from="source/value" to="twin/input/gain" when="present"/>
    <connect from="absent/value" to="twin/parameter/gain" when="present"/>)");
  ASSERT_TRUE(Apply({ConnectPorts{"/demo/source/value", "/demo/twin/parameter/gain"}}));
  ASSERT_TRUE(Apply({DisconnectPorts{"/demo/source/value", "/demo/twin/parameter/gain"}}));
  EXPECT_THAT(Late(), ElementsAre("/demo/source/output/value -> /demo/twin/input/gain",
                                  "/demo/absent/value -> /demo/twin/parameter/gain waits"));
}

/// Has the parameter before the input of its name.
class TwinTheOtherWay final : public Module {
 public:
  using Module::Module;
  Parameter<double> gain{this, "gain", {.default_value = 1.0}};
  Input<double> input{this, "gain"};

 private:
  void Update() override {}
};

// What is called so is an input, whatever else of that name there is, and before it.
TEST_F(ParameterInputs, ThatWaitAreFoundByTheirKind) {
  workshop_.Add<TwinTheOtherWay>("test/other_twin");
  Build(R"(<module name="filter" type="test/filter"/><module name="twin" type="test/other_twin"/>
    <connect from="absent/value" to="filter/value twin/gain" when="present"/>)");
  EXPECT_THAT(Late(), ElementsAre("/demo/absent/value -> /demo/filter/input/value waits",
                                  "/demo/absent/value -> /demo/twin/input/gain waits"));
  for (const std::string to : {"/demo/filter/value", "/demo/twin/gain"}) {
    const auto noted = Late();
    const ConnectPorts connected{"/demo/absent/value", to, {.when_present = true}};
    EXPECT_THAT(Apply({connected}).diagnostics.ToString(), HasSubstr("already"));
    EXPECT_FALSE(Apply({DisconnectPorts{"/demo/absent/value", to}, SetParameter{"/demo/nowhere", "1"}}));
    EXPECT_THAT(Late(), noted);
    EXPECT_TRUE(
        Apply({DisconnectPorts{"/demo/absent/value", to}, connected, DisconnectPorts{"/demo/absent/value", to}}));
  }
  EXPECT_THAT(Late(), IsEmpty());
}

TEST_F(ParameterInputs, AnEndThatCannotBeOneIsNotNoted) {
  Build(R"(<connect from="absent/value" to="later/value" when="present"/>)");
  ASSERT_TRUE(Apply({CreateModule{"/demo/later", "test/source"}}));  // which has an output of that name
  ASSERT_TRUE(Apply({DeleteElement{"/demo/later"}}));
  ASSERT_TRUE(Apply({CreateModule{"/demo/later", "test/sink"}, CreateModule{"/demo/absent", "test/source"}}));
  EXPECT_THAT(Late(), ElementsAre("/demo/absent/output/value -> /demo/later/input/value"));
}

TEST_F(ParameterInputs, OfAnotherApplicationAreConnectedOnceWhenTheyAreReady) {
  Build(std::string(kModules) + R"(<connect from="source/value" to="/more/other/gain" when="present"/>)");
  ASSERT_TRUE(workshop_.Build("<application name=\"more\">" + std::string(kModules) + "</application>"));
  EXPECT_THAT(Late(), ElementsAre("/demo/source/output/value -> /more/other/parameter/gain"));
}

// While the one is not there, its name is that of a group in the only other one.
TEST_F(ParameterInputs, AreWaitedForInTheirApplicationAlone) {
  const auto load = [&](const std::string& name, const std::string& inside) {
    return workshop_.Build("<application name=\"" + name + "\">" + inside + "</application>");
  };
  const std::string robot = R"(<module name="source" type="test/source"/>)";
  ASSERT_TRUE(load("robot", robot));
  ASSERT_TRUE(load("sim", R"(<group name="robot"><module name="other" type="test/source"/></group>)"));
  const std::string to = "/sim/robot/other/gain";
  ASSERT_TRUE(Apply({ConnectPorts{"/robot/source/value", to, {.when_present = true}}}));
  ASSERT_TRUE(workshop_.runtime.Delete(**workshop_.runtime.root().Find("/robot")));
  EXPECT_THAT(Late(), ElementsAre("/robot/source/output/value -> /sim/robot/other/parameter/gain waits"));
  ASSERT_TRUE(load("robot", robot));
  EXPECT_THAT(Late(), ElementsAre("/robot/source/output/value -> /sim/robot/other/parameter/gain"));
  ASSERT_TRUE(workshop_.runtime.Delete(**workshop_.runtime.root().Find("/robot")));
  EXPECT_TRUE(Apply({DisconnectPorts{"/robot/source/value", to}}));
  EXPECT_THAT(Late(), IsEmpty());
}

}  // namespace
}  // namespace runnel::testing
