#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/module/module.h"
#include "core/port/typed_ports.h"
#include "plugins/parameters/parameter.h"

namespace runnel::flow {

/// What makes ports for values of the type called `name`, as in `<port type="…">`, for modules that take any. Errors: no
/// such type, with the nearest; none that a port of a loaded plugin has. Locks.
[[nodiscard]] Result<const TypedPorts*> FindPortsByName(const std::string& name);

/// What modules have in common that pass on values of any type, without copying them: `type` says which, in the words
/// of `<port type="…">`, and is known before the ports are made.
///
/// Ports:   of the C++ class behind the type; who connects them sees no difference to those of other modules.
/// Errors:  a type that no port of a loaded plugin has; one whose values only its own module can make.
class PassingModule : public Module {
 public:
  explicit PassingModule(const Placement& placement) : Module(placement) {}

  StaticParameter<std::string> type{
      this, "type", {.default_value = "double", .description = "of the values that pass"}};

 protected:
  /// One input, and a place for its value.
  Result<void> Construct() override { return MakePorts(1, 1); }
  /// In Construct(): inputs called in1, in2 …, or in if there is but one, the output out, and places for values.
  Result<void> MakePorts(std::size_t inputs, std::size_t places);

  [[nodiscard]] const std::vector<std::unique_ptr<Port>>& inputs() const noexcept { return inputs_; }
  [[nodiscard]] Port& input() const noexcept { return *inputs_.front(); }
  [[nodiscard]] HeldValues& values() const noexcept { return *values_; }
  /// While a stop of the only input is in force: has the safe value pass in each cycle, and what waits at the input go.
  /// Whether one is.
  bool PassSafeValue();
  /// Publishes what is in the place, and lets go of it.
  void Pass(std::size_t place) {
    values_->Forward(*output_, place);
    values_->Drop(place);
  }

 private:
  // Leases go before the ports, though they need not.
  std::vector<std::unique_ptr<Port>> inputs_;
  std::unique_ptr<Port> output_;
  std::unique_ptr<HeldValues> values_;
};

/// Passes on what comes by one of its inputs, as `selected` says, which may be fed by an output. When that changes,
/// what is at the other input then passes at once.
class Mux final : public PassingModule {
 public:
  using PassingModule::PassingModule;
  static constexpr std::uint32_t kMostInputs = 64;

  StaticParameter<std::uint32_t> input_count{
      this, "inputs", {.default_value = 2, .bounds = {2, kMostInputs}, .description = "how many: in1, in2 …"}};
  Parameter<std::uint32_t> selected{
      this,
      "selected",
      {.default_value = 1, .bounds = {0, kMostInputs}, .description = "the number of the input that passes; 0: none"}};

 private:
  Result<void> Construct() override { return MakePorts(input_count.Get(), 1); }

  void OnParametersChanged() override {
    has_switched_ = true;
    if (selected.Get() > inputs().size()) {
      log().Warn("input {} is selected, and there are {}: nothing passes", selected.Get(), inputs().size());
    }
  }

  void Update() override {
    const std::uint32_t number = selected.Get();
    if (number == 0 || number > inputs().size()) return;
    const bool is_new = values().Read(*inputs()[number - 1], 0);
    if ((is_new || has_switched_) && values().Find(0) != nullptr) Pass(0);
    has_switched_ = false;
    values().Drop(0);
  }

  bool has_switched_ = false;
};

/// Passes on what comes by any of its inputs: of connections with a queue each value, of others the newest in each
/// cycle; in the order of the inputs.
class Merge final : public PassingModule {
 public:
  using PassingModule::PassingModule;

  StaticParameter<std::uint32_t> input_count{
      this, "inputs", {.default_value = 2, .bounds = {2, 64}, .description = "how many: in1, in2 …"}};

 private:
  Result<void> Construct() override { return MakePorts(input_count.Get(), 1); }

  void Update() override {
    for (const auto& each : inputs()) {
      while (values().Next(*each, 0)) Pass(0);
    }
  }
};

/// Passes values on while it is open, which may be said by an output; a safe value also while it is closed. When it
/// opens, the newest of what has come meanwhile passes, and what has come before that is forgotten.
class Gate final : public PassingModule {
 public:
  using PassingModule::PassingModule;

  Parameter<bool> open{this, "open", {.default_value = true, .description = "whether values pass"}};

 private:
  void Update() override {
    const bool was_open = std::exchange(was_open_, open.Get());
    if (PassSafeValue() || !was_open_) return;
    if (was_open) {
      while (values().Next(input(), 0)) Pass(0);
      return;
    }
    while (values().Next(input(), 0)) {
    }
    if (values().Find(0) != nullptr) Pass(0);
  }

  bool was_open_ = true;
};

/// Passes the newest value on, no more often than every `period`, but a safe value at once; with `repeats` also if none
/// has come since.
class Sample final : public PassingModule {
 public:
  using PassingModule::PassingModule;

  Parameter<double> interval{this,
                             "period",
                             {.default_value = 1.0,
                              .bounds = {0, 1e6},
                              .unit = "s",
                              .description = "from one value to the next at least; 0: each cycle"}};
  Parameter<bool> repeats{this, "repeats", {.description = "passes the newest value again where none has come"}};

 private:
  void Update() override {
    if (PassSafeValue() || (has_passed_ && now() - last_ < FromSeconds(interval.Get()))) return;
    const bool is_new = values().Read(input(), 0);
    if (values().Find(0) == nullptr || !(is_new || repeats.Get())) return values().Drop(0);
    Pass(0);
    // From when it was due, so that cycles that are a little late do not add up.
    const Time due = last_ + FromSeconds(interval.Get());
    last_ = has_passed_ && now() - due < period() ? due : now();
    has_passed_ = true;
  }

  bool has_passed_ = false;
  Time last_{};
};

/// Passes each value on `delay` after it came, with the timestamp that it had, but a safe value at once. Holds so many
/// at most: of more, the oldest pass early.
class Delay final : public PassingModule {
 public:
  using PassingModule::PassingModule;

  StaticParameter<std::uint32_t> capacity{
      this, "capacity", {.default_value = 100, .bounds = {1, 10'000}, .description = "how many values may wait"}};
  Parameter<double> delay{
      this,
      "delay",
      {.default_value = 0.1, .bounds = {0, 1e6}, .unit = "s", .description = "how long each value waits"}};

 private:
  Result<void> Construct() override {
    came_.resize(capacity.Get() + 1);  // one to be filled while all others are
    return MakePorts(1, came_.size());
  }

  void Update() override {
    for (const bool is_stopped = PassSafeValue(); count_ > 0 && is_stopped; --count_) {
      values().Drop(oldest_);
      oldest_ = (oldest_ + 1) % came_.size();
    }
    const Duration wanted = FromSeconds(delay.Get());
    std::size_t place = oldest_ + count_;
    while (values().Next(input(), place % came_.size())) {
      came_[place % came_.size()] = now();
      if (++count_ == came_.size()) PassOldest();
      place = oldest_ + count_;
    }
    while (count_ > 0 && now() - came_[oldest_] >= wanted) PassOldest();
  }

  void PassOldest() {
    Pass(oldest_);
    oldest_ = (oldest_ + 1) % came_.size();
    --count_;
  }

  std::vector<Time> came_;  // by places
  std::size_t oldest_ = 0;
  std::size_t count_ = 0;
};

}  // namespace runnel::flow
