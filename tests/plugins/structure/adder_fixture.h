#pragma once

#include <deque>

#include "plugins/structure/change_history.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {

/// As many inputs as its parameter says; publishes their sum, and how often it has done so.
class Adder final : public Module {
 public:
  explicit Adder(const Placement& placement) : Module(placement) { KeepState(count); }

  StaticParameter<std::uint32_t> inputs{this, "inputs", {.default_value = 2, .bounds = {1, 8}}};
  Parameter<int> offset{this, "offset"};
  std::deque<Input<int>> in;
  std::deque<Parameter<int>> weights;
  Output<int> sum{this, "sum"};
  Count count;
  int told = 0;

 private:
  Result<void> Construct() override {
    if (inputs.Get() == 7) return Error{.message = "seven is not to be had"};
    for (std::uint32_t i = 1; i <= inputs.Get(); ++i) {
      in.emplace_back(this, "in" + std::to_string(i));
      weights.emplace_back(this, "weight" + std::to_string(i), ParameterOptions<int>{.default_value = 1});
    }
    return {};
  }
  void OnParametersChanged() override { ++told; }
  void Update() override {
    int total = offset.Get();
    for (std::size_t i = 0; i < in.size(); ++i) total += weights[i].Get() * in[i].Get();
    ++count.value;
    sum.Publish(total);
  }
};

class StaticParameterTest : public EditorTest {
 protected:
  StaticParameterTest() {
    Register<Adder>("test/adder");
    Must({CreateModule{"/app/counter", "test/counter"},
          CreateModule{"/app/adder", "test/adder", {{"inputs", "3"}, {"offset", "100"}}},
          CreateModule{"/app/sink", "test/sink"}, ConnectPorts{"/app/counter/out", "/app/adder/in1"},
          ConnectPorts{"/app/counter/out", "/app/adder/in3", {.queue = 4}},
          ConnectPorts{"/app/adder/sum", "/app/sink/in", {.queue = 100}},
          ConnectPorts{"/app/adder/sum", "/app/sink/side"}});
  }
  Adder& adder() { return At<Adder>("/app/adder"); }
  ChangeHistory history_{editor};
};

}  // namespace runnel::test
