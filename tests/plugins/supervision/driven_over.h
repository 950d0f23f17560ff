#pragma once

#include "plugins/parameters/parameter.h"
#include "tests/plugins/supervision/supervised_robot.h"

namespace runnel::supervised {

/// Passes on what is new, as long as `open` says so; nothing here looks how old it is.
class Passing final : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in"};
  Output<double> out{this, "out"};
  Parameter<bool> open{this, "open", {.default_value = true}};

 private:
  void Update() override {
    if (const auto value = in.Read(); value && value.is_new() && open.Get()) out.Publish(*value);
  }
};

/// Something moves by what comes over the module.
class DrivenOver : public Driven {
 protected:
  DrivenOver() {
    MustSucceed(Port::Disconnect(robot.laser.out, robot.reader.in));
    MustSucceed(Port::Connect(robot.laser.out, passing.in));
    MustSucceed(Port::Connect(passing.out, robot.reader.in));
    MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
    RunOn();
    EXPECT_EQ(robot.seen, 1);
    (void)robot.Messages();
  }
  /// A switch that somebody holds, connected to the input.
  struct DeadMan final : Module {
    using Module::Module;
    Output<bool> out{this, "out"};
    bool is_held = true;
    void Update() override {
      if (is_held) out.Publish(true);
    }
  };
  void HeldOpen(Port& input) {
    MustSucceed(Port::Connect(dead_man.out, input));
    MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
    RunOn();
    EXPECT_EQ(robot.seen, 1);
    (void)robot.Messages();
  }
  DeadMan& dead_man = robot.runtime.Create<DeadMan>(robot.runtime.root(), "dead_man");
  Passing& passing = robot.runtime.Create<Passing>(robot.runtime.root(), "passing");
};

}  // namespace runnel::supervised
