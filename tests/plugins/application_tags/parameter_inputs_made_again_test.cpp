// What outputs have set of the parameters of modules that are made again.

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/module/group.h"
#include "core/module/hand_over.h"
#include "plugins/parameters/value_to_save.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/parameter_inputs_fixture.h"

namespace runnel::testing {
namespace {

/// In the place of a Source, until it throws.
class Fragile final : public Module {
 public:
  using Module::Module;
  Output<double> value{this, "value"};
  Parameter<double> gain{this, "gain", {.default_value = 1.0, .bounds = {0.0, 10.0}, .unit = "m"}};
  static inline bool throws = false;

 private:
  void Update() override {
    if (throws) throw std::runtime_error("no");
  }
};

/// Refuses to be replaced, after what comes before it in a change set has been.
class Stubborn final : public Module {
 public:
  explicit Stubborn(const Placement& placement) : Module(placement) {
    Annotate(std::make_unique<BeforeHandOver>([]() -> BeforeHandOver::Held { throw std::runtime_error("not now"); }));
  }

 private:
  void Update() override {}
};

/// Counts its goals.
class Goals final : public Module {
 public:
  using Module::Module;
  Input<double> goal{this, "goal"};
  static inline int count = 0;

 private:
  void Update() override { count += goal.Read().is_new() ? 1 : 0; }
};

struct Box final : Group {
  using Group::Group;
  Result<void> Construct() override {
    runtime().Create<Source>(*this, "part");
    return {};
  }
};

struct Named final : Module {
  using Module::Module;
  Parameter<std::string> label{this, "label", {.default_value = "none"}};
  void Update() override {}
};

// The source says 2, and is at rest at 0.
class MadeAgain : public ParameterInputs {
 protected:
  MadeAgain() {
    workshop_.Add<Fragile>("test/fragile");
    workshop_.Add<Stubborn>("test/stubborn");
    workshop_.Add<Goals>("test/goals");
    workshop_.Add<Box>("test/box");
    workshop_.Add<Named>("test/named");
    Fragile::throws = false;
  }

  void Start(const std::string& inside) {
    Build(R"(<thread name="control" period="10ms"/><clock type="simulated" speed="0"/>
      <module name="source" type="test/source" thread="control"/>
      <driving port="source/value" safe="0" command="velocity"/>)" +
          inside);
    scheduler_.emplace(workshop_.runtime, SchedulerOptionsOf(**workshop_.runtime.root().Find("/demo")));
    changes_.emplace(workshop_.runtime, workshop_.plugins.modules(), &*scheduler_);
    history_.emplace(*changes_);
  }
  void Say(double value) { workshop_.Get<Source>("/demo/source").value.Publish(value); }
  Port& Output() { return workshop_.Get<Port>("/demo/source/output/value"); }
  // The parameter, some cycles later.
  double Run(const std::string& parameter = "/demo/other/parameter/gain") {
    EXPECT_TRUE(scheduler_->RunUntil(Time(std::chrono::milliseconds(end_ += 20))));
    const auto found = workshop_.runtime.root().Find(parameter);
    return found ? std::stod(dynamic_cast<Configurable&>(**found).ToText()) : -1;
  }
  void Do(const ChangeSet& changes) {
    const ChangeOutcome outcome = changes_->Apply(changes);
    EXPECT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  [[nodiscard]] std::string SavedValue(const std::string& parameter) {
    const std::lock_guard lock(workshop_.runtime.structure_mutex());
    FrameworkElement& found = **workshop_.runtime.root().Find(parameter);
    return TextToSave(found, dynamic_cast<Configurable&>(found));
  }

  std::optional<Scheduler> scheduler_;
  std::optional<StructureEditor> changes_;
  std::optional<ChangeHistory> history_;
  int end_ = 0;
};

constexpr const char* kOther = R"(<module name="other" type="test/source" thread="control"/>)";
constexpr const char* kConnected = R"(<module name="other" type="test/source" thread="control"/>
  <connect from="source/value" to="other/gain"/>)";

/// By which readers of the source find 0 from then on, and nothing comes that is new.
class Halted : public MadeAgain, public ::testing::WithParamInterface<std::string> {
 protected:
  void Halt() {
    if (GetParam() == "stop") {
      ASSERT_TRUE(workshop_.runtime.robot_stop().Press("a test"));
    } else if (GetParam() == "block") {
      ASSERT_TRUE(Output().Block());
    } else if (GetParam() == "hand") {
      const double value = 0;
      const std::lock_guard lock(workshop_.runtime.structure_mutex());
      ASSERT_TRUE(PublishByHand(Output(), &value));
    } else {
      Say(0);
    }
  }
  // A module that has taken the place throws, after `meanwhile`.
  void Fail(const std::function<void()>& meanwhile) {
    Do({ReplaceModule{"/demo/other", "test/fragile", {}, 1000}});
    meanwhile();
    EXPECT_EQ(Run(), 2);
    Halt();
    EXPECT_EQ(Run(), 0);
    Fragile::throws = true;
    Run();
    const auto faults = scheduler_->TakeFaults();
    ASSERT_NE(dynamic_cast<Source*>(*workshop_.runtime.root().Find("/demo/other")), nullptr)
        << (faults.empty() ? "" : faults.front().message);
    EXPECT_EQ(Run(), 0);
    EXPECT_FALSE(Output().outgoing().empty());
  }
};
INSTANTIATE_TEST_SUITE_P(, Halted, ::testing::Values("stop", "block", "hand", "published"),
                         [](const auto& given) { return given.param; });

TEST_P(Halted, IsNotTakenBackWithAChange) {
  const std::vector<std::pair<ChangeSet, std::string>> all{
      {{ReplaceModule{"/demo/other", "test/source"}}, "other"},
      {{SetParameter{"/demo/other/text", "static"}}, "other"},
      {{RenameElement{"/demo/other", "another"}}, "another"},
      {{DisconnectPorts{"/demo/source/value", "/demo/other/gain"}, ReplaceModule{"/demo/other", "test/source"},
        ConnectPorts{"/demo/source/value", "/demo/other/gain"}},
       "other"}};
  Start(kConnected);
  for (const auto& [changes, name] : all) {
    (void)workshop_.runtime.robot_stop().Release("a test");
    Output().Unblock();
    Output().Release();
    Run();
    Say(2);
    EXPECT_EQ(Run(), 2);
    const std::string renamed = "/demo/" + name + "/parameter/gain";
    ASSERT_TRUE(history_->Apply(changes));
    EXPECT_EQ(Run(renamed), 2);
    Halt();
    EXPECT_EQ(Run(renamed), 0);
    for (int round = 0; round < 2; ++round) {
      ASSERT_TRUE(history_->Undo());
      EXPECT_EQ(Run(), 0) << round;
      ASSERT_TRUE(history_->Redo());
      EXPECT_EQ(Run(renamed), 0) << round;
    }
    ASSERT_TRUE(history_->Undo());
  }
}

TEST_P(Halted, IsNotTakenBackWithAModuleThatHasFailed) {
  Start(kConnected);
  Say(2);
  EXPECT_EQ(Run(), 2);
  Fail([] {});
}

TEST_P(Halted, IsNotTakenBackThoughConnectedToTheModuleThatHasFailed) {
  Start(kOther);
  Do({SetParameter{"/demo/other/gain", "5"}});
  Say(2);
  EXPECT_EQ(Run(), 5);
  Fail([this] { Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}}); });
}

TEST_F(MadeAgain, HasWhatAPersonHasSetSince) {
  Start(kConnected);
  Say(2);
  EXPECT_EQ(Run(), 2);
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/source"}}));
  Do({SetParameter{"/demo/other/gain", "5"}});
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 5);
  for (int round = 0; round < 2; ++round) {  // set by a person before, and by the output
    Do({ReplaceModule{"/demo/other", "test/source", {{"gain", "3"}}}});
    EXPECT_EQ(Run(), 3) << "until the next one comes";
    Say(4);
    EXPECT_EQ(Run(), 4);
  }
}

TEST_F(MadeAgain, HasWhatAnOutputHasSetSince) {
  Start(kConnected);
  Do({SetParameter{"/demo/other/gain", "5"}});
  ASSERT_TRUE(history_->Apply({ReplaceModule{"/demo/other", "test/source"}}));
  Say(2);
  EXPECT_EQ(Run(), 2);
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run(), 2);
}

TEST_F(MadeAgain, IsSavedWithoutWhatAnOutputHasSet) {
  Start(R"(<module name="other" type="test/source" thread="control"><parameter name="gain" value="1.5"/></module>
    <connect from="source/value" to="other/gain"/>)");
  Say(2);
  EXPECT_EQ(Run(), 2);
  std::string name = "other";
  const auto saved = SavedValue("/demo/other/parameter/gain");
  EXPECT_NE(saved, "2");
  for (const ChangeSet& changes :
       {ChangeSet{ReplaceModule{"/demo/other", "test/source"}}, ChangeSet{SetParameter{"/demo/other/text", "static"}},
        ChangeSet{RenameElement{"/demo/other", "another"}}}) {
    Do(changes);
    if (std::holds_alternative<RenameElement>(changes[0])) name = "another";
    EXPECT_EQ(SavedValue("/demo/" + name + "/parameter/gain"), saved);
    EXPECT_EQ(Run("/demo/" + name + "/parameter/gain"), 2);
  }
}

// What could not be read again would keep the module from being made again.
TEST_F(MadeAgain, HasNoTextThatCannotBeWritten) {
  Start(R"(<module name="named" type="test/named" thread="control"/><connect from="source/label" to="named/label"/>)");
  auto& output = workshop_.Get<Source>("/demo/source").label;
  const auto label = [&] {
    Run();
    return *workshop_.Get<Named>("/demo/named").label.Get();
  };
  output.Publish("good");
  EXPECT_EQ(label(), "good");
  for (const std::string& bad : {std::string("a\x01z"), std::string("a\0z", 3), std::string("\xff")}) {
    output.Publish(bad);
    EXPECT_EQ(label(), "good");
    Do({ReplaceModule{"/demo/named", "test/named"}});
    EXPECT_EQ(label(), "good");
  }
}

TEST_F(MadeAgain, OfAPartIsConnectedAgain) {
  Start(R"(<module name="box" type="test/box" thread="control"/>
    <connect from="source/value" to="box/part/gain"/>)");
  Say(2);
  EXPECT_EQ(Run("/demo/box/part/parameter/gain"), 2);
  Do({ReplaceModule{"/demo/box", "test/box"}});
  EXPECT_EQ(Run("/demo/box/part/parameter/gain"), 2);
  Say(3);
  EXPECT_EQ(Run("/demo/box/part/parameter/gain"), 3);
  EXPECT_FALSE(changes_->Apply({ReplaceModule{"/demo/box", "test/source"}})) << "whose gain is another one";
}

// Of any input with limits.
TEST_F(MadeAgain, ReadsNothingTwice) {
  Start(std::string(kOther) + R"(<module name="stubborn" type="test/stubborn" thread="control"/>
    <module name="goals" type="test/goals" thread="control"><input name="goal" default="1" maximum="10"/></module>
    <connect from="source/value" to="goals/goal"/>)");
  Run();
  Say(2);
  Run();
  Goals::count = 0;
  const ReplaceModule swap{"/demo/goals", "test/goals"};
  EXPECT_FALSE(changes_->Apply({swap, ReplaceModule{"/demo/stubborn", "test/stubborn"}}));
  Run();
  EXPECT_EQ(Goals::count, 0) << "is refused";
  ASSERT_TRUE(history_->Apply({swap}));
  Run();
  ASSERT_TRUE(history_->Undo());
  Run();
  ASSERT_TRUE(history_->Apply({RenameElement{"/demo/goals", "another"}}));
  Run();
  EXPECT_EQ(Goals::count, 0);
  Say(20);
  Run();
  EXPECT_EQ(Goals::count, 0) << "is too much";
  Say(3);
  Run();
  EXPECT_EQ(Goals::count, 1);
}

TEST_F(ParameterInputs, AreConnectedAndTakenOverInOneSet) {
  Build(kModules);
  EXPECT_TRUE(
      Apply({ConnectPorts{"/demo/source/value", "/demo/other/gain"}, ReplaceModule{"/demo/other", "test/source"}}));
  EXPECT_FALSE(workshop_.Get<Port>("/demo/source/output/value").outgoing().empty());
}

}  // namespace
}  // namespace runnel::testing
