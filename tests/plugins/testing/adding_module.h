#pragma once

#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/parameters/parameter.h"

namespace runnel::test {

/// Publishes the sum of what is in its queue, or of the newest, every second cycle; throws where it is too much.
class AddingModule final : public Module {
 public:
  using Module::Module;

  Input<double> values{this, "values"};
  Input<std::vector<double>> lists{this, "lists"};
  Output<double> sum{this, "sum"};
  Parameter<double> limit{this, "limit", {.default_value = 100, .bounds = {0, 1000}}};

  Duration seen_period{};
  Time seen_time{};

 private:
  void Update() override {
    seen_period = period();
    seen_time = now();
    if (is_second_ = !is_second_; is_second_) return;
    double total = 0;
    if (values.Drain([&](const auto& value) { total += *value; }) == 0) total = values.Get();
    if (total > limit.Get()) throw std::runtime_error("the sum is too large: " + std::to_string(total));
    sum.Publish(total);
  }
  bool is_second_ = false;
};

/// Does in its cycle what it is told to do.
class HastyModule final : public Module {
 public:
  using Module::Module;

  bool allocates = false, locks = false, calls = false;

 private:
  void Update() override;
  std::unique_ptr<std::string> kept_;
  std::mutex mutex_;
};

}  // namespace runnel::test
