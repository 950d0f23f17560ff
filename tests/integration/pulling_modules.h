#pragma once

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"

namespace runnel::test {

/// Makes values only for those who pull them: 1, 2, 3 …
class CountingProvider final : public Module {
 public:
  explicit CountingProvider(const Placement& placement) : Module(placement) {
    count.SetProvider([this](double& value) {
      value = ++made_;
      return true;
    });
  }

  Output<double> count{this, "count", {.pullable = true}};

 private:
  void Update() override {}

  double made_ = 0;
};

/// Reads one value a cycle, and tells which.
class CountReader final : public Module {
 public:
  using Module::Module;

  Input<double> in{this, "in"};
  Output<double> seen{this, "seen"};

 private:
  void Update() override {
    if (const auto value = in.Read()) seen.Publish(*value);
  }
};

}  // namespace runnel::test
