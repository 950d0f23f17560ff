#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/element/file_notes.h"
#include "core/module/group.h"
#include "core/module/group_parameter.h"
#include "core/module/kept_state.h"
#include "plugins/parameters/value_to_save.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/parameter_inputs_fixture.h"

namespace runnel::testing {

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

/// One parameter, by its former name and by the one of now.
struct OldName final : Module {
  using Module::Module;
  Parameter<double> boost{this, "boost", {.default_value = 1.0}};
  void Update() override {}
};
struct NewName final : Module {
  explicit NewName(const Placement& placement) : Module(placement) {
    gain.Annotate(std::make_unique<FormerName>("boost"));
  }
  Parameter<double> gain{this, "gain", {.default_value = 1.0}};
  static inline bool throws = false;
  void Update() override {
    if (throws) throw std::runtime_error("no");
  }
};

/// Two parts, each with a gain: "gain" is that of a, "speed" that of b.
struct Pair final : Group {
  using Group::Group;
  Result<void> Construct() override {
    for (const char* const part : {"a", "b"}) runtime().Create<Source>(*this, part);
    runtime().Create<GroupParameter>(*this, "gain", std::vector<std::string>{"a/gain"});
    runtime().Create<GroupParameter>(*this, "speed", std::vector<std::string>{"b/gain"});
    runtime().Create<GroupParameter>(*this, "both", std::vector<std::string>{"b/gain", "a/gain"});
    return {};
  }
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
    workshop_.Add<OldName>("test/old");
    workshop_.Add<NewName>("test/new");
    workshop_.Add<Pair>("test/pair");
    Fragile::throws = NewName::throws = false;
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
  // They find 2 again.
  void Resume(const std::string& parameter = "/demo/other/parameter/gain") {
    (void)workshop_.runtime.robot_stop().Release("a test");
    Output().Unblock();
    Output().Release();
    Run();
    Say(2);
    EXPECT_EQ(Run(parameter), 2);
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
inline constexpr const char* kOther = R"(<module name="other" type="test/source" thread="control"/>)";
inline constexpr const char* kConnected = R"(<module name="other" type="test/source" thread="control"/>
  <connect from="source/value" to="other/gain"/>)";

}  // namespace runnel::testing
