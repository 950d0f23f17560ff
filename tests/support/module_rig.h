#pragma once

#include <map>
#include <memory>
#include <string>
#include <type_traits>

#include "core/base/clock.h"
#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/port/cycle.h"
#include "core/port/input.h"
#include "core/port/output.h"

namespace runnel::test {

/// One module on its own: feeds its inputs, runs its tasks cycle by cycle, without a scheduler.
///
///     ModuleRig<Bumper> rig;
///     rig.Prepare();
///     rig.Feed(rig.module.truth, Contact{true, 0.5});
///     rig.RunCycle();
///     EXPECT_TRUE(rig.Last(rig.module.contact).is_touching);
template <typename M>
class ModuleRig {
 public:
  explicit ModuleRig(Duration period = std::chrono::milliseconds(50)) : period_(period) {}

  Result<void> Prepare() { return runtime.MakeReady(module); }

  /// Publishes `value` through an output of the rig's own that is connected to `input`.
  template <typename T>
  void Feed(Input<T>& input, std::type_identity_t<T> value) {
    auto& feeder = feeders_[input.name()];
    if (!feeder) {
      feeder = std::make_unique<Output<T>>(feeder_group_, input.name());
      const auto connected = Port::Connect(*feeder, input);
      if (!connected) throw ElementError(connected.error());
    }
    const CycleScope cycle({now_, period_});
    static_cast<Output<T>&>(*feeder).Publish(std::move(value));
  }

  /// What `output` published last; as constructed if nothing.
  template <typename T>
  [[nodiscard]] T Last(const Output<T>& output) const {
    T last{};
    output.VisitLatest([&](const void* value, Time) { last = *static_cast<const T*>(value); });
    return last;
  }

  /// One cycle at the current time, which then moves on by a period.
  void RunCycle() {
    const CycleScope cycle({now_, period_});
    for (const Task& task : module.template FindAnnotation<Executable>()->tasks()) task.run();
    now_ += period_;
  }
  /// Lets time pass without a cycle.
  void Wait(Duration duration) { now_ += duration; }

  Runtime runtime;
  M& module = runtime.Create<M>(runtime.root(), "module");

 private:
  FrameworkElement& feeder_group_ = runtime.Create<Group>(runtime.root(), "feeders");
  std::map<std::string, std::unique_ptr<Port>> feeders_;
  Duration period_;
  Time now_{};
};

}  // namespace runnel::test
