#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/cycle.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/scheduling/fault.h"
#include "plugins/scheduling/task_watch.h"

namespace runnel::test {

#ifdef RUNNEL_TEST_PLUGIN_FOLDER
inline constexpr const char* kBuiltPlugins = RUNNEL_TEST_PLUGIN_FOLDER;
#else
inline constexpr const char* kBuiltPlugins = "";
#endif

/// What the rig of a module can do whatever the module's class is: see ModuleRig.
class ModuleRigBase {
 public:
  ModuleRigBase(const ModuleRigBase&) = delete;
  ModuleRigBase& operator=(const ModuleRigBase&) = delete;

  /// Sets a parameter by its text format. Throws ElementError: no such parameter, with the nearest; not a value of it.
  void Set(std::string_view parameter, std::string_view text);
  /// Parameters are set; by the first cycle at the latest. Errors: what the module says.
  Result<void> Prepare();

  // By name; the group's may be left out: "scan". Throw ElementError: no such port, with the nearest; another type.
  template <typename T>
  [[nodiscard]] Input<T>& input(std::string_view name) {
    return As<Input<T>>(FindPort(name, Port::Direction::kInput), TypeOf<T>());
  }
  template <typename T>
  [[nodiscard]] Output<T>& output(std::string_view name) {
    return As<Output<T>>(FindPort(name, Port::Direction::kOutput), TypeOf<T>());
  }

  /// From now on values that are fed wait in a queue at the input. Before the first is fed.
  void UseQueue(Port& input, std::size_t capacity, OnFull on_full = OnFull::kDropOldest);
  void UseQueue(std::string_view input, std::size_t capacity, OnFull on_full = OnFull::kDropOldest) {
    UseQueue(FindPort(input, Port::Direction::kInput), capacity, on_full);
  }
  /// Publishes `value` through an output of the rig's own that is connected to `input`.
  template <typename T>
  void Feed(Input<T>& input, std::type_identity_t<T> value) {
    std::unique_ptr<Port>& feeder = feeders_[&input];
    if (!feeder) {
      feeder = std::make_unique<Output<T>>(surroundings_, FreeNameFor(input));
      Connect(*feeder, input, queues_[&input]);
    }
    const CycleScope cycle({now(), period_});
    static_cast<Output<T>&>(*feeder).Publish(std::move(value));
  }
  template <typename T>
  void Feed(std::string_view input_name, T value) {
    Feed(input<T>(input_name), std::move(value));
  }

  /// What `output` published last; as constructed if nothing.
  template <typename T>
  [[nodiscard]] T Last(const Output<T>& output) const {
    T last{};
    output.VisitLatest([&](const void* value, Time) { last = *static_cast<const T*>(value); });
    return last;
  }
  template <typename T>
  [[nodiscard]] T Last(std::string_view output_name) {
    return Last(output<T>(output_name));
  }
  /// An input of the rig's own in whose queue all that `output` publishes from now on waits; of more than
  /// `capacity` values the oldest are dropped.
  template <typename T>
  [[nodiscard]] Input<T>& Follow(Output<T>& output, std::size_t capacity = 100) {
    auto follower = std::make_unique<Input<T>>(surroundings_, FreeNameFor(output));
    Input<T>& made = *follower;
    followers_.push_back(std::move(follower));
    Connect(output, made, {.queue = capacity});
    return made;
  }

  /// One cycle at the current time, which then moves on by a period. Lets through what the module throws.
  void RunCycle();
  void RunCycles(std::uint64_t count) {
    for (; count > 0; --count) RunCycle();
  }
  /// Runs until the module throws, or for so many cycles. The fault as an application would report it.
  std::optional<Fault> RunUntilFault(std::uint64_t most_cycles = 1);
  /// Lets time pass without a cycle.
  void Wait(Duration duration) { clock_.Advance(duration); }
  [[nodiscard]] Time now() const noexcept { return clock_.Now(); }
  /// For matchers, which are handed everything as constant.
  [[nodiscard]] ModuleRigBase& changeable() const noexcept { return *self_; }
  /// Is there whenever a task of the module runs, from the next cycle on. nullptr: nobody.
  void SetWatch(TaskWatch* watch);

 private:
  ManualClock clock_;

 public:
  Runtime runtime;

 protected:
  explicit ModuleRigBase(Duration period);
  ~ModuleRigBase();
  /// Throws ElementError: no such plugin or type, with the nearest; the module's constructor threw.
  FrameworkElement& Make(std::string_view type, const std::filesystem::path& plugin_folder);
  void set_module(FrameworkElement& module) { module_ = &module; }

 private:
  [[nodiscard]] Port& FindPort(std::string_view name, Port::Direction direction);
  [[nodiscard]] std::string FreeNameFor(const Port& port) const;
  static void Connect(Port& from, Port& to, const ConnectOptions& options);
  [[noreturn]] static void RefuseType(const Port& port, const TypeInfo& wanted);
  template <typename Wanted>
  static Wanted& As(Port& port, const TypeInfo& type) {
    if (auto* const typed = dynamic_cast<Wanted*>(&port)) return *typed;
    RefuseType(port, type);
  }

  PluginManager plugins_;
  FrameworkElement& surroundings_;
  std::map<const Port*, ConnectOptions> queues_;
  std::map<const Port*, std::unique_ptr<Port>> feeders_;
  std::vector<std::unique_ptr<Port>> followers_;
  const Duration period_;
  ModuleRigBase* const self_ = this;
  FrameworkElement* module_ = nullptr;
  std::uint64_t cycles_ = 0;
  TaskWatch* watch_ = nullptr;
  std::vector<std::unique_ptr<WatchedTask>> watched_;  // by watch_, one for each task; empty: not yet
};

/// One module on its own: feeds its inputs, runs its tasks cycle by cycle, without a scheduler, in time that passes by
/// nothing else, and shows what it publishes. By class
///
///     ModuleRig<Bumper> rig;
///     rig.Feed(rig.module.truth, Contact{true, 0.5});
///     rig.RunCycle();
///     EXPECT_TRUE(rig.Last(rig.module.contact).is_touching);
///
/// or by type, of the plugin that the type's name begins with:
///
///     ModuleRig rig("sensors/bumper");
///     rig.Feed("truth", Contact{true, 0.5});
///     rig.RunCycle();
///     EXPECT_TRUE(rig.Last<Contact>("contact").is_touching);
///
/// Plugins are looked for where runnel_test(… PLUGINS …) says that they are built, then as PluginManager does.
///
/// Threads: one.
template <typename M = FrameworkElement>
class ModuleRig : public ModuleRigBase {
 public:
  explicit ModuleRig(Duration period = std::chrono::milliseconds(50))
      : ModuleRigBase(period), module(runtime.Create<M>(runtime.root(), "module")) {
    set_module(module);
  }
  explicit ModuleRig(std::string_view type,
                     Duration period = std::chrono::milliseconds(50)) requires std::is_same_v<M, FrameworkElement>
      : ModuleRigBase(period), module(Make(type, kBuiltPlugins)) {
    set_module(module);
  }

  M& module;
};
ModuleRig(const char*)->ModuleRig<FrameworkElement>;
ModuleRig(const char*, Duration)->ModuleRig<FrameworkElement>;

}  // namespace runnel::test
