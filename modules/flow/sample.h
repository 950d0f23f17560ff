#pragma once

#include <algorithm>

#include "modules/flow/passing_module.h"
#include "plugins/parameters/parameter.h"

namespace runnel::flow {

/// Passes the newest value on, no more often than every `period`; with `repeats` also if none has come since.
class Sample final : public PassingModule {
 public:
  using PassingModule::PassingModule;

  Parameter<double> interval{this,
                             "period",
                             {.default_value = 1.0,
                              .bounds = {0, 1e6},
                              .unit = "s",
                              .description = "from one value to the next at least; 0: each cycle"}};
  Parameter<bool> repeats{
      this, "repeats", {.description = "passes the newest value again where none has come"}};

 private:
  Result<void> Construct() override { return MakePorts(1, 1); }

  void Update() override {
    if (has_passed_ && now() - last_ < FromSeconds(interval.Get())) return;
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

}  // namespace runnel::flow
