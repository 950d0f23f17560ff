#pragma once

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/plugin/module_type_name.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/proxy_port.h"
#include "plugins/parameters/parameter.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/structure_editor.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// What counters remember, and leave to each other.
struct Count {
  int value = 0;
};

/// Publishes 1, 2, 3 …, one a cycle.
class Counter : public Module {
 public:
  explicit Counter(const Placement& placement) : Module(placement) { KeepState(count); }
  Output<int> out{this, "out"};
  Parameter<int> step{this, "step", {.default_value = 1}};
  StaticParameter<std::string> label{this, "label", {.default_value = "none"}};
  Count count;

 protected:
  void Update() override { out.Publish(count.value += step.Get()); }
};

/// Counts in the same way, and has one parameter and one port of its own.
class OtherCounter final : public Counter {
 public:
  using Counter::Counter;
  Input<int> extra{this, "extra"};
  Parameter<int> own{this, "own", {.default_value = 7}};
};

/// Passes on what it takes from its queue, and what it reads.
class Sink final : public Module {
 public:
  explicit Sink(const Placement& placement) : Module(placement) { KeepState(taken); }
  Input<int> in{this, "in"};
  Input<int> side{this, "side", {.required = true}};
  Output<int> sum{this, "sum"};
  std::vector<int> taken;
  static inline std::mutex mutex;

 private:
  void Update() override {
    // Tests may look at the list meanwhile.
    const std::lock_guard lock(mutex);
    in.Drain([this](const auto& value) { taken.push_back(*value); });
    sum.Publish(static_cast<int>(taken.size()));
  }
};

class Faulty final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};
  Parameter<int> good_cycles{this, "good_cycles", {.default_value = 0}};

 private:
  void Update() override {
    if (cycles_++ >= good_cycles.Get()) throw std::runtime_error("is faulty");
    out.Publish(-1);
  }
  int cycles_ = 0;
};

class NeverReady final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};

 private:
  Result<void> Prepare() override { return Error{.message = "has no device"}; }
  void Update() override {}
};

class NeverMade final : public Module {
 public:
  explicit NeverMade(const Placement& placement) : Module(placement) { throw std::runtime_error("cannot be made"); }

 private:
  void Update() override {}
};

/// Another type under the same names.
class TextCounter final : public Module {
 public:
  using Module::Module;
  Output<std::string> out{this, "out"};

 private:
  void Update() override {}
};

class Silent final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override {}
};

template <typename M>
ModuleType TypeCalled(std::string name) {
  return {std::move(name), "", "test",
          [](const Placement& placement) { return std::unique_ptr<FrameworkElement>(std::make_unique<M>(placement)); }};
}

/// An application with a counter and a sink, on a clock of the test's choice.
class EditorTest : public ::testing::Test {
 protected:
  explicit EditorTest(SchedulerOptions::ClockKind clock = SchedulerOptions::ClockKind::kSimulated)
      : scheduler(runtime, {.clock = clock}) {
    (void)TypeOf<int>();
    Register<Counter>("test/counter");
    Register<OtherCounter>("test/other_counter");
    Register<Sink>("test/sink");
    Register<Faulty>("test/faulty");
    Register<NeverReady>("test/never_ready");
    Register<NeverMade>("test/never_made");
    Register<TextCounter>("test/text_counter");
    Register<Silent>("test/silent");
    runtime.Create<Group>(runtime.root(), "app");
    MustReady();
    CreateThread(runtime, "fast", {.period = 10ms});
    CreateThread(runtime, "slow", {.period = 20ms});
  }
  ~EditorTest() override { scheduler.Stop(); }

  template <typename M>
  void Register(std::string name) {
    ASSERT_TRUE(modules.Add(TypeCalled<M>(std::move(name))));
  }
  void MustReady() { ASSERT_TRUE(runtime.MakeReady(runtime.root())); }

  void Must(const ChangeSet& changes) {
    const ChangeOutcome outcome = editor.Apply(changes);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  /// The message of what must be refused, with the structure as it was.
  std::string Refusal(const ChangeSet& changes) {
    const std::string before = Structure();
    const ChangeOutcome outcome = editor.Apply(changes);
    EXPECT_FALSE(outcome);
    EXPECT_FALSE(outcome.diagnostics.ok());
    EXPECT_EQ(Structure(), before);
    return outcome.diagnostics.ToString();
  }

  /// Everything: elements with types and values, connections with options.
  std::string Structure() {
    const std::lock_guard lock(runtime.structure_mutex());
    std::string text;
    runtime.root().Visit([&](FrameworkElement& each) {
      text += each.path() + " " + FindModuleType(each) + " #" + std::to_string(each.id());
      if (const auto* value = dynamic_cast<const Configurable*>(&each)) text += value->ToText();
      text += "\n";
      const auto* const port = dynamic_cast<const Port*>(&each);
      if (port == nullptr) return;
      for (const Connection& edge : port->outgoing()) {
        text += "  > " + edge.to->path() + " " + std::to_string(edge.options.queue) + "\n";
      }
      for (const Port* from : port->incoming()) text += "  < " + from->path() + "\n";
    });
    return text;
  }

  /// Simulated clock: so many cycles of the fast thread.
  void Steps(int count) { ASSERT_TRUE(scheduler.RunUntil(runtime.clock().Now() + count * 10ms)); }

  template <typename E>
  E& At(const std::string& path) {
    const std::lock_guard lock(runtime.structure_mutex());
    auto found = runtime.root().Find(path);
    if (!found) throw std::runtime_error(found.error().ToString());
    return dynamic_cast<E&>(**found);
  }
  [[nodiscard]] bool Exists(const std::string& path) {
    const std::lock_guard lock(runtime.structure_mutex());
    return runtime.root().Find(path).has_value();
  }

  Runtime runtime;
  ModuleRegistry modules;
  Scheduler scheduler;
  StructureEditor editor{runtime, modules, &scheduler};
};

class RealEditorTest : public EditorTest {
 protected:
  RealEditorTest() : EditorTest(SchedulerOptions::ClockKind::kReal) {}
};

}  // namespace runnel::test
