#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "core/module/group.h"
#include "core/module/hand_over.h"
#include "plugins/parameters/value_to_save.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
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

inline constexpr const char* kOther = R"(<module name="other" type="test/source" thread="control"/>)";
inline constexpr const char* kConnected = R"(<module name="other" type="test/source" thread="control"/>
  <connect from="source/value" to="other/gain"/>)";

}  // namespace runnel::testing
