#pragma once

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/module/kept_state.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "core/port/hand_slot.h"
#include "core/port/port_stop.h"
#include "core/port/proxy_port.h"
#include "core/port/stand_in.h"
#include "core/types/type_of.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing::driving_swap {

/// Declares nothing. Of a unit of its own type of number.
template <int kUnit>
struct Undeclared final : Module {
  using Module::Module;
  static constexpr const char* kUnits[] = {"", "m/s", "us", "V", "%", "rad"};
  Input<double> in{this, "in", {.unit = kUnits[kUnit]}};
  void Update() override {}
};
template <DrivingKind kKind, int kSafe>
struct Declared final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.drives = true, .command = kKind, .safe_value = AnyValue(double(kSafe))}};
  void Update() override {}
};
struct Defaulted final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.limits = {.default_value = 1500.}}};
  void Update() override {}
};
/// Nobody can take its place.
struct Keeper final : Module {
  explicit Keeper(const Placement& at) : Module(at) { KeepState(state); }
  struct State {
    State() = default;
    State(const State&) = default;
    State& operator=(const State&) { throw std::runtime_error("no"); }
  };
  Output<double> value{this, "value"};
  State state;
  void Update() override {}
};

struct Boxed final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    return Port::Connect(in, runtime().Create<Undeclared<1>>(*this, "motor").in);
  }
};

template <typename Part, int kVersion = 0>
struct BoxOf final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().template Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    return Port::Connect(in, runtime().template Create<Part>(*this, "part").in);
  }
};

inline double Number(const AnyValue& value) { return *static_cast<const double*>(value.get()); }

class DrivingSwap : public ::testing::Test {
 protected:
  DrivingSwap() {
    Know(shop_);
    shop_.Add<Keeper>("test/keeper");
  }
  static void Know(SavingWorkshop& shop) {
    shop.Add<Undeclared<0>>("test/number");
    shop.Add<Undeclared<1>>("test/motor");
    shop.Add<Undeclared<2>>("test/pulse");
    shop.Add<Undeclared<3>>("test/volts");
    shop.Add<Undeclared<4>>("test/percent");
    shop.Add<Undeclared<5>>("test/servo");
    shop.Add<Declared<DrivingKind::kVelocity, 1500>>("test/esc");
    shop.Add<Declared<DrivingKind::kVelocity, 0>>("test/drive");
    shop.Add<Declared<DrivingKind::kEffort, 0>>("test/throttle");
  }
  void Load(const std::string& type, const std::string& mark, const std::string& source = "test/source") {
    WriteAll(folder_ / "app.xml", "<application name=\"demo\">\n  <module name=\"s\" type=\"" + source +
                                      "\"/>\n  <module name=\"m\" type=\"" + type +
                                      "\"/>\n  <connect from=\"s/value\" to=\"m/in\"/>\n" + mark + "</application>\n");
    application_ = shop_.Load(folder_ / "app.xml");
    ASSERT_NE(application_, nullptr);
  }
  Port& In() { return shop_.Get<Port>("/demo/m/input/in"); }
  double Safe() { return *static_cast<const double*>(In().stop()->safe_value().get()); }
  double ReadUnderStop() {
    shop_.runtime.robot_stop().Press("a test");
    return dynamic_cast<Input<double>&>(In()).Get();
  }
  std::string SavedText() { return shop_.Text(*application_, folder_.path()); }
  /// What drives in the saved application, when it is loaded.
  std::optional<DrivingMark> Again() {
    SavingWorkshop other;
    Know(other);
    WriteAll(folder_ / "again.xml", SavedText());
    EXPECT_NE(other.Load(folder_ / "again.xml"), nullptr);
    const auto stop = other.Get<Port>("/demo/m/input/in").stop();
    if (!stop || !stop->robot()) return {};
    return DrivingMark{AnyValue(*static_cast<const double*>(stop->safe_value().get())), stop->brake(), stop->command()};
  }

  TestFolder folder_;
  SavingWorkshop shop_;
  StructureEditor editor_{shop_.runtime, shop_.plugins.modules(), nullptr};
  ChangeHistory history_{editor_};
  FrameworkElement* application_ = nullptr;
};

inline constexpr const char* kMarks[] = {"", "  <driving port=\"m/in\"/>\n",
                                         "  <driving port=\"m/in\" brake=\"0.4 s\"/>\n"};

}  // namespace runnel::testing::driving_swap
