#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/module/sense_control_module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/scheduling/fault_dispatcher.h"

namespace runnel::testing {

/// Who ran, in which order.
using Diary = std::vector<std::string>;

/// What has been logged since the last call.
inline std::vector<Fault> TakeAll(FaultDispatcher& faults) {
  std::vector<Fault> taken;
  faults.Take(taken);
  return taken;
}

/// No module: a test publishes by it.
class Feeder final : public Group {
 public:
  using Group::Group;
  Output<double> out{*this, "out"};
};

/// Adds what it reads and one, publishes the sum, and notes its name.
class Relay final : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in"};
  Output<double> out{this, "out"};
  Diary* diary = nullptr;

 private:
  void Update() override {
    if (diary != nullptr) diary->push_back(name());
    const auto read = in.Read();
    out.Publish(read ? *read + 1 : 1);
  }
};

/// Notes "name sense" and "name control"; passes data through in both directions.
class Base final : public SenseControlModule {
 public:
  using SenseControlModule::SenseControlModule;
  Input<double> raw{sensor_inputs(), "raw"};
  Output<double> seen{sensor_outputs(), "seen"};
  Input<double> wanted{controller_inputs(), "wanted"};
  Output<double> command{controller_outputs(), "command"};
  Diary* diary = nullptr;

 private:
  void Sense() override { Pass("sense", raw, seen); }
  void Control() override { Pass("control", wanted, command); }
  void Pass(const std::string& what, Input<double>& from, Output<double>& to) {
    if (diary != nullptr) diary->push_back(name() + " " + what);
    const auto read = from.Read();
    to.Publish(read ? *read : 0);
  }
};

/// Does in each cycle what a test says.
class Doing final : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in", {.trigger = true}};
  Output<double> out{this, "out"};
  std::function<void(Doing&)> action = [](Doing&) {};
  [[nodiscard]] Time cycle_time() const { return now(); }
  [[nodiscard]] static Duration cycle_period() { return period(); }

 private:
  void Update() override { action(*this); }
};

inline void MustSucceed(const Result<void>& result) {
  if (!result) throw std::runtime_error(result.error().ToString());
}

inline Time At(std::int64_t milliseconds) { return Time(std::chrono::milliseconds(milliseconds)); }

}  // namespace runnel::testing

namespace runnel {
namespace {

// What most tests with these modules name.
using namespace std::chrono_literals;
using testing::At;
using testing::Diary;
using testing::Doing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::MustSucceed;
using testing::Relay;
using ::testing::SizeIs;

}  // namespace
}  // namespace runnel
