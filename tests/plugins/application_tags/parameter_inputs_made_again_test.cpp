// The inputs by which outputs set parameters, of modules that are made again.

#include <chrono>
#include <mutex>
#include <string>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/parameter_inputs_fixture.h"

namespace runnel::testing {
namespace {

TEST_F(ParameterInputs, KeepWhatIsSetAtThem) {
  for (const std::string connect : {"", R"(<connect from="absent/value" to="other/gain" when="present"/>)"}) {
    SavingWorkshop workshop;
    ASSERT_TRUE(workshop.Build("<application name=\"demo\">" + std::string(kModules) + connect +
                               R"(<driving port="other/gain" safe="0" command="velocity"/></application>)"))
        << workshop.diagnostics.ToString();
    const auto feed = [&](const std::string& module) -> Port& {
      return workshop.Get<Port>("/demo/" + module + "/parameter/gain/feed/gain");
    };
    StructureEditor editor(workshop.runtime, workshop.plugins.modules(), nullptr);
    ASSERT_TRUE(feed("other").Block());
    ASSERT_TRUE(editor.Apply({ReplaceModule{"/demo/other", "test/source"}}));
    ASSERT_TRUE(editor.Apply({RenameElement{"/demo/other", "another"}, SetParameter{"/demo/another/text", "static"}}));
    EXPECT_TRUE(feed("another").is_driving());
    EXPECT_TRUE(feed("another").is_blocked());
  }
}

TEST_F(ParameterInputs, AreConnectedAndTakenOverInOneSet) {
  Build(kModules);
  EXPECT_TRUE(
      Apply({ConnectPorts{"/demo/source/value", "/demo/other/gain"}, ReplaceModule{"/demo/other", "test/source"}}));
  EXPECT_FALSE(workshop_.Get<Port>("/demo/source/output/value").outgoing().empty());
}

// Whatever makes the module again makes the input again, at which something was set.
TEST_F(ParameterInputs, KeepWhatIsSetAtThemWhereAChangeIsTakenBack) {
  Build(R"(<module name="source" type="test/source"/>
    <module name="other" type="test/source"><input name="gain" maximum="1"/></module>
    <driving port="other/gain" safe="0" command="velocity"/>)");
  const auto feed = [&]() -> Port& { return workshop_.Get<Port>("/demo/other/parameter/gain/feed/gain"); };
  ChangeHistory history(editor_);
  for (const ChangeSet& changes :
       {ChangeSet{DeleteElement{"/demo/other"}}, ChangeSet{ReplaceModule{"/demo/other", "test/source"}},
        ChangeSet{DisconnectPorts{"/demo/source/value", "/demo/other/gain"}, DeleteElement{"/demo/other"}}}) {
    if (changes.size() > 1) {
      ASSERT_TRUE(Apply({ConnectPorts{"/demo/source/value", "/demo/other/gain"}}));
    }
    ASSERT_TRUE(history.Apply(changes));
    ASSERT_TRUE(history.Undo());
    EXPECT_TRUE(feed().is_driving());
    EXPECT_TRUE(feed().limits().has_some());
  }
}

// A person has set the parameter after what the input had by itself.
TEST_F(ParameterInputs, OfWhatIsMadeAgainSetNothingByThemselves) {
  Build(R"(<thread name="control" period="10ms"/><clock type="simulated" speed="0"/>
    <module name="source" type="test/source"/>
    <module name="other" type="test/source" thread="control"><input name="gain" default="0.5" maximum="1"/></module>)");
  FrameworkElement& application = **workshop_.runtime.root().Find("/demo");
  Scheduler scheduler(workshop_.runtime, SchedulerOptionsOf(application));
  StructureEditor editor(workshop_.runtime, workshop_.plugins.modules(), &scheduler);
  ChangeHistory history(editor);
  auto run = [&, end = 0]() mutable {
    EXPECT_TRUE(scheduler.RunUntil(Time(std::chrono::milliseconds(end += 20))));
    return workshop_.Get<Source>("/demo/other").gain.Get();
  };
  const auto feed = [&]() -> Port& { return workshop_.Get<Port>("/demo/other/parameter/gain/feed/gain"); };
  EXPECT_EQ(run(), 0.5);
  for (const bool is_by_hand : {false, true}) {
    if (is_by_hand) {
      const double value = 0.8;
      const std::lock_guard lock(workshop_.runtime.structure_mutex());
      ASSERT_TRUE(PublishByHand(feed(), &value));
    }
    EXPECT_EQ(run(), is_by_hand ? 0.8 : 0.5);
    ASSERT_TRUE(editor.Apply({SetParameter{"/demo/other/gain", "2"}}));
    for (const ChangeSet& changes :
         {ChangeSet{ReplaceModule{"/demo/other", "test/source"}}, ChangeSet{SetParameter{"/demo/other/text", "static"}},
          ChangeSet{DeleteElement{"/demo/other"}}}) {
      ASSERT_TRUE(history.Apply(changes));
      if (std::holds_alternative<DeleteElement>(changes[0])) {
        ASSERT_TRUE(history.Undo());
      }
      EXPECT_EQ(run(), 2) << is_by_hand;
      EXPECT_TRUE(feed().limits().has_some());
      EXPECT_EQ(feed().is_set_by_hand(), is_by_hand);
    }
  }
  ASSERT_TRUE(feed().Release());
  ASSERT_TRUE(editor.Apply({ConnectPorts{"/demo/source/value", "/demo/other/gain"}}));
  workshop_.Get<Source>("/demo/source").value.Publish(9);
  EXPECT_EQ(run(), 0.5) << "9 is too much";
}

// Also if no cycle has found the safe value before the module is made again.
TEST_F(ParameterInputs, OfWhatIsMadeAgainHaveTheirSafeValue) {
  Build(R"(<thread name="control" period="10ms"/><clock type="simulated" speed="0"/>
    <module name="other" type="test/source" thread="control"/>
    <driving port="other/gain" safe="0" command="velocity"/>)");
  Scheduler scheduler(workshop_.runtime, SchedulerOptionsOf(**workshop_.runtime.root().Find("/demo")));
  StructureEditor editor(workshop_.runtime, workshop_.plugins.modules(), &scheduler);
  ChangeHistory history(editor);
  const auto feed = [&]() -> Port& { return workshop_.Get<Port>("/demo/other/parameter/gain/feed/gain"); };
  for (int round = 1; round <= 2; ++round) {
    ASSERT_TRUE(editor.Apply({SetParameter{"/demo/other/gain", "2"}}));
    ASSERT_TRUE(feed().Block());
    ASSERT_TRUE(history.Apply(round == 1 ? ChangeSet{ReplaceModule{"/demo/other", "test/source"}}
                                         : ChangeSet{DeleteElement{"/demo/other"}}));
    if (round == 2) {
      ASSERT_TRUE(history.Undo());
    }
    EXPECT_TRUE(scheduler.RunUntil(Time(std::chrono::milliseconds(20 * round))));
    EXPECT_EQ(workshop_.Get<Source>("/demo/other").gain.Get(), 0) << round;
    feed().Unblock();
  }
}

TEST_F(ParameterInputs, OfAPartAreNotThoseOfTheModuleInThePlaceOfAll) {
  Build(R"(<group name="box"><module name="part" type="test/source"/></group>
    <driving port="box/part/gain" safe="0" command="velocity"/>)");
  EXPECT_FALSE(Apply({ReplaceModule{"/demo/box", "test/source"}}));
  EXPECT_TRUE(workshop_.Get<Port>("/demo/box/part/parameter/gain/feed/gain").is_driving());
}

}  // namespace
}  // namespace runnel::testing
