#pragma once

#include "modules/flow/passing_module.h"
#include "plugins/parameters/parameter.h"

namespace runnel::flow {

/// Passes values on while it is open, which may be said by an output. When it opens, the newest of what has come
/// meanwhile passes, and what has come before that is forgotten.
class Gate final : public PassingModule {
 public:
  using PassingModule::PassingModule;

  Parameter<bool> open{this, "open", {.default_value = true, .description = "whether values pass"}};

 private:
  Result<void> Construct() override { return MakePorts(1, 1); }

  void Update() override {
    const bool was_open = std::exchange(was_open_, open.Get());
    if (!was_open_) return;
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

}  // namespace runnel::flow
