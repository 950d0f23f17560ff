// What stops a module in the place of another one: what was marked of the place, then what it declares itself; and what there
// was before, on the way back.

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/module/kept_state.h"
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

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;

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
    WriteAll(folder_ / "app.xml", "<application name=\"demo\">\n  <module name=\"s\" type=\"" + source + "\"/>\n  <module name=\"m\" type=\"" +
                                      type + "\"/>\n  <connect from=\"s/value\" to=\"m/in\"/>\n" + mark + "</application>\n");
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

constexpr const char* kMarks[] = {"", "  <driving port=\"m/in\"/>\n", "  <driving port=\"m/in\" brake=\"0.4 s\"/>\n"};

TEST_F(DrivingSwap, WhatWasNotMarkedIsAsTheNewModuleDeclares) {
  for (const char* const mark : kMarks) {
    Load("test/esc", mark);
    ASSERT_EQ(Safe(), 1500);
    ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/drive"}}));
    EXPECT_EQ(Safe(), 0) << mark;
    EXPECT_EQ(In().stop()->brake() != Duration{}, std::string(mark).find("brake") != std::string::npos);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

TEST_F(DrivingSwap, OfWhatWasAVelocityByItsUnitTheNewOneSaysItsSafeValue) {
  Load("test/motor", kMarks[1]);
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
  EXPECT_EQ(ReadUnderStop(), 1500);
}

TEST_F(DrivingSwap, OnesSafeValueIsNotThatOfAnotherUnit) {
  Load("test/esc", "");
  const auto refused = history_.Apply({ReplaceModule{"/demo/m", "test/motor"}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("/demo/m/input/in: is in m/s, and its safe value, 1500, is not"));
  EXPECT_EQ(Safe(), 1500) << "as it was";
}

TEST_F(DrivingSwap, NorIsOneThatWasMarked) {
  Load("test/number", "  <driving port=\"m/in\" safe=\"1500\" command=\"velocity\"/>\n");
  EXPECT_FALSE(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}}));
  EXPECT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
}

TEST_F(DrivingSwap, NorIsZeroOfAnEffortThatOfAPosition) {
  Load("test/throttle", "");
  EXPECT_FALSE(history_.Apply({ReplaceModule{"/demo/m", "test/servo"}}));
  EXPECT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}}));
}

// By a rule, as while what feeds it is paused, or for somebody who drives it no more.
TEST_F(DrivingSwap, WhatStandsAtRestDoesSoAtTheNewSafeValue) {
  for (const auto setter : {Port::Setter::kRule, Port::Setter::kPerson}) {
    Load("test/esc", "");
    const auto held = [&](const char* type, double value, double read) {
      ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(value)), setter));
      const auto slot = HandSlot::Of(In());
      slot->hold = std::make_unique<HandSlot::Hold>();
      slot->hold->safe_value = AnyValue(Safe());
      ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", type}}));
      EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), read);
      EXPECT_EQ(*static_cast<const double*>(HandSlot::Find(In())->hold->safe_value.get()), Safe());
    };
    held("test/drive", 1500, 0);
    held("test/esc", 0, 1500);
    held("test/drive", 1400, 1400);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

// Also where no stop is left.
TEST_F(DrivingSwap, WhatStandsAtRestDoesSoAfterAnUndo) {
  Load("test/motor", "");
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
  ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(1500.)), Port::Setter::kRule));
  ASSERT_TRUE(history_.Undo());
  EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), 0);
}

TEST_F(DrivingSwap, ABlockHasASafeValueOfTheNewUnit) {
  shop_.Add<Defaulted>("test/defaulted");
  for (const bool is_in_force : {true, false}) {
    Load("test/defaulted", "");
    ASSERT_TRUE(In().Block());
    ASSERT_EQ(Safe(), 1500);
    if (!is_in_force) In().Unblock();
    EXPECT_EQ(bool(history_.Apply({ReplaceModule{"/demo/m", "test/servo"}})), !is_in_force);
    EXPECT_EQ(In().stop() != nullptr, is_in_force);
    EXPECT_EQ(bool(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}})), is_in_force) << "from rad to m/s";
    EXPECT_TRUE(!is_in_force || dynamic_cast<Input<double>&>(In()).Get() == 0);
    EXPECT_EQ(In().is_blocked(), is_in_force);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

/// As a plugin that is loaded anew with another version of it.
struct Corrected final : Module {
  using Module::Module;
  static inline double safe = 0;
  Input<double> in{this, "in", safe == 0 ? InputOptions{} : InputOptions{.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(safe)}};
  void Update() override {}
};

TEST_F(DrivingSwap, AnUndoMakesWhatItsModuleDeclaresNow) {
  shop_.Add<Corrected>("test/corrected");
  for (const double before : {0., 1500.}) {
    Corrected::safe = before;
    Load("test/corrected", "");
    ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/drive"}}));
    Corrected::safe = 1480;
    ASSERT_TRUE(history_.Undo());
    EXPECT_EQ(ReadUnderStop(), 1480);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

TEST_F(DrivingSwap, ACompositeHasTheMarkOfThePlaceToo) {
  shop_.Add<Boxed>("test/boxed");
  Load("test/motor", kMarks[1]);
  const auto swapped = history_.Apply({ReplaceModule{"/demo/m", "test/boxed"}});
  ASSERT_TRUE(swapped) << swapped.diagnostics.ToString();
  EXPECT_TRUE(shop_.Get<Port>("/demo/m/in").is_driving());
  EXPECT_THAT(SavedText(), HasSubstr("<driving port=\"m/in\""));
  ASSERT_TRUE(history_.Undo());
  EXPECT_TRUE(In().is_driving());
}

TEST_F(DrivingSwap, ACompositeHasWhatTheModuleDeclared) {
  shop_.Add<Boxed>("test/boxed");
  Load("test/throttle", "");
  ASSERT_TRUE(In().Block());
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/boxed"}}));
  EXPECT_TRUE(shop_.Get<Port>("/demo/m/in").is_driving());
  EXPECT_TRUE(shop_.Get<Port>("/demo/m/in").is_blocked());
  EXPECT_THAT(SavedText(), HasSubstr("<driving port=\"m/in\""));
}

TEST_F(DrivingSwap, NorIsASafeValueThatOfACompositeOfAnotherUnit) {
  shop_.Add<Boxed>("test/boxed");
  for (const char* const mark : kMarks) {
    Load("test/esc", mark);
    EXPECT_FALSE(history_.Apply({ReplaceModule{"/demo/m", "test/boxed"}}));
    EXPECT_EQ(ReadUnderStop(), 1500);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

TEST_F(DrivingSwap, WhatWasDeletedMeanwhileIsAsItWas) {
  Load("test/motor", kMarks[1]);
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
  ASSERT_TRUE(history_.Apply({DeleteElement{"/demo/m"}}));
  ASSERT_TRUE(history_.Undo());
  EXPECT_EQ(Safe(), 1500);
  ASSERT_TRUE(history_.Undo());
  EXPECT_EQ(Safe(), 0);
}

TEST_F(DrivingSwap, WhatIsInheritedIsNoMarkAfterADeletion) {
  Load("test/esc", "");
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/number"}}));
  ASSERT_TRUE(history_.Apply({DeleteElement{"/demo/m"}}));
  ASSERT_TRUE(history_.Undo());
  EXPECT_EQ(Safe(), 1500);
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/drive"}}));
  EXPECT_EQ(Safe(), 0);
}

TEST_F(DrivingSwap, WhatItBringsGoesWithItsUndo) {
  for (const char* const type : {"test/esc", "test/throttle"}) {
    Load("test/motor", "");
    ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", type}}));
    const double safe = Safe();
    for (int i = 0; i < 2; ++i) {
      const auto undone = history_.Undo();
      ASSERT_TRUE(undone) << undone.diagnostics.ToString();
      EXPECT_FALSE(In().is_driving()) << type;
      EXPECT_EQ(In().incoming().size(), 1U);
      ASSERT_TRUE(history_.Redo());
      EXPECT_EQ(Safe(), safe) << type;
    }
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

TEST_F(DrivingSwap, TheUndoLeavesTheBlockOfThePlace) {
  Load("test/motor", "");
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
  ASSERT_TRUE(In().Block());
  ASSERT_TRUE(history_.Undo());
  EXPECT_TRUE(In().is_blocked());
  EXPECT_EQ(Safe(), 0);
  ASSERT_TRUE(history_.Redo());
  EXPECT_TRUE(In().is_blocked());
  EXPECT_EQ(Safe(), 1500);
}

TEST_F(DrivingSwap, ThatIsFollowedByAFailureIsTakenBack) {
  Load("test/motor", "", "test/keeper");
  EXPECT_FALSE(history_.Apply({ReplaceModule{"/demo/m", "test/throttle"}, ReplaceModule{"/demo/s", "test/keeper"}}));
  EXPECT_EQ(In().incoming().size(), 1U);
  EXPECT_FALSE(In().is_driving());
}

TEST_F(DrivingSwap, OfAMarkedPortThatIsNotConnectedIsRefusedToo) {
  Load("test/number", "  <driving port=\"m/in\" safe=\"0\" command=\"position\"/>\n");
  ASSERT_TRUE(history_.Apply({DisconnectPorts{"/demo/s/value", "/demo/m/in"}}));
  const auto refused = history_.Apply({ReplaceModule{"/demo/m", "test/motor"}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("is in m/s, which is that of a velocity, and is said to be a position"));
}

TEST_F(DrivingSwap, WhatTheFormerModuleHasSaidIsSaved) {
  Load("test/motor", kMarks[2]);
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/number"}}));
  const auto velocity = Again();
  ASSERT_TRUE(velocity);
  EXPECT_EQ(velocity->command, DrivingKind::kVelocity);
  EXPECT_EQ(velocity->brake, 400ms);
  ASSERT_TRUE(history_.Undo());
  EXPECT_THAT(SavedText(), HasSubstr(std::string(kMarks[2]).substr(2)));
}

TEST_F(DrivingSwap, WhatOnlyTheFormerModuleDeclaredIsSaved) {
  Load("test/throttle", "");
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/number"}}));
  ASSERT_TRUE(In().is_driving());
  const auto effort = Again();
  ASSERT_TRUE(effort);
  EXPECT_EQ(effort->command, DrivingKind::kEffort);
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/throttle"}}));
  EXPECT_FALSE(In().FindMark()) << "its module says it again";
}

struct Fails final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.drives = true, .command = DrivingKind::kEffort, .safe_value = AnyValue(0.0)}};
  void Update() override { throw std::runtime_error("no such device"); }
};

TEST_F(DrivingSwap, OfWhatFailsInItsFirstCyclesIsTakenBackWithItsConnections) {
  shop_.Add<Fails>("test/fails");
  Load("test/motor", "");
  Scheduler scheduler(shop_.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  StructureEditor editor(shop_.runtime, shop_.plugins.modules(), &scheduler);
  ASSERT_TRUE(editor.Apply({ReplaceModule{"/demo/m", "test/fails"}}));
  for (int i = 0; i < 5; ++i) scheduler.Step();
  EXPECT_EQ(FindModuleType(*In().parent()->parent()), "test/motor");
  EXPECT_EQ(In().incoming().size(), 1U);
  EXPECT_FALSE(In().is_driving());
}

TEST_F(DrivingSwap, NorIsOneThatWasMarkedFartherUp) {
  for (const char* const mark : {"safe=\"1500\" command=\"velocity\"", "safe=\"0\" command=\"position\""}) {
    Load("test/number", "  <driving port=\"s/value\" " + std::string(mark) + "/>\n");
    EXPECT_FALSE(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}}));
    EXPECT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
    EXPECT_TRUE(history_.Undo());
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
  Load("test/number", "  <driving port=\"s/value\" safe=\"0\" command=\"velocity\"/>\n");
  EXPECT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}}));
}

// As a replay takes the places of outputs.
TEST_F(DrivingSwap, AFileThatIsSavedMeanwhileKeepsTheMarkOfThePlace) {
  Load("test/number", "  <driving port=\"s/value\" safe=\"0\" command=\"velocity\"/>\n");
  const std::string mark = "<driving port=\"s/value\" safe=\"0\" command=\"velocity\"/>";
  auto& source = shop_.Get<Port>("/demo/s/output/value");
  auto& elsewhere = shop_.runtime.Create<FrameworkElement>(shop_.runtime.root(), "elsewhere");
  const auto output = source.MakeOutput(elsewhere, "played", {});
  output->TakeOver(source);
  EXPECT_THAT(SavedText(), HasSubstr(mark));
  source.TakeOver(*output);
  EXPECT_THAT(SavedText(), HasSubstr(mark));
}

// A unit that is neither of a position nor of a velocity is that of an effort only if nobody says otherwise.
TEST_F(DrivingSwap, APulseMayBeAVelocity) {
  for (const char* const type : {"test/pulse", "test/volts", "test/percent"}) {
    Load(type, "  <driving port=\"m/in\" safe=\"1500\" command=\"velocity\"/>\n");
    EXPECT_EQ(In().stop()->command(), DrivingKind::kVelocity);
    EXPECT_FALSE(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}}));
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

}  // namespace
}  // namespace runnel::testing
