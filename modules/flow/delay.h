#pragma once

#include <cstdint>
#include <vector>

#include "modules/flow/passing_module.h"
#include "plugins/parameters/parameter.h"

namespace runnel::flow {

/// Passes each value on `delay` after it came, with the timestamp that it had. Holds so many at most: of more, the
/// oldest pass early.
class Delay final : public PassingModule {
 public:
  using PassingModule::PassingModule;

  StaticParameter<std::uint32_t> capacity{
      this,
      "capacity",
      {.default_value = 100, .bounds = {1, 10'000}, .description = "how many values may wait"}};
  Parameter<double> delay{this,
                          "delay",
                          {.default_value = 0.1,
                           .bounds = {0, 1e6},
                           .unit = "s",
                           .description = "how long each value waits"}};

 private:
  Result<void> Construct() override {
    came_.resize(capacity.Get() + 1);  // one to be filled while all others are
    return MakePorts(1, came_.size());
  }

  void Update() override {
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
