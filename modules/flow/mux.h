#pragma once

#include <cstdint>

#include "modules/flow/passing_module.h"
#include "plugins/parameters/parameter.h"

namespace runnel::flow {

/// Passes on what comes by one of its inputs, as `selected` says, which may be fed by an output. When that changes,
/// what is at the other input then passes at once.
class Mux final : public PassingModule {
 public:
  using PassingModule::PassingModule;
  static constexpr std::uint32_t kMostInputs = 64;

  StaticParameter<std::uint32_t> input_count{
      this,
      "inputs",
      {.default_value = 2, .bounds = {2, kMostInputs}, .description = "how many: in1, in2 …"}};
  Parameter<std::uint32_t> selected{
      this,
      "selected",
      {.default_value = 1,
       .bounds = {0, kMostInputs},
       .description = "the number of the input that passes; 0: none"}};

 private:
  Result<void> Construct() override { return MakePorts(input_count.Get(), 1); }

  void OnParametersChanged() override {
    has_switched_ = true;
    if (selected.Get() > inputs().size()) {
      log().Warn("input {} is selected, and there are {}: nothing passes", selected.Get(),
                 inputs().size());
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

}  // namespace runnel::flow
