#pragma once

#include <cstdint>

#include "modules/flow/passing_module.h"

namespace runnel::flow {

/// Passes on what comes by any of its inputs: of connections with a queue each value, of others the newest in each
/// cycle; in the order of the inputs.
class Merge final : public PassingModule {
 public:
  using PassingModule::PassingModule;

  StaticParameter<std::uint32_t> input_count{
      this,
      "inputs",
      {.default_value = 2, .bounds = {2, 64}, .description = "how many: in1, in2 …"}};

 private:
  Result<void> Construct() override { return MakePorts(input_count.Get(), 1); }

  void Update() override {
    for (const auto& each : inputs()) {
      while (values().Next(*each, 0)) Pass(0);
    }
  }
};

}  // namespace runnel::flow
