// What the tables of swaps do not see: composites in a row, units that change, ports farther up, and places that a recording has.

#include "plugins/parameters/static_parameter.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/driving_swap_fixture.h"

namespace runnel::testing {
namespace {

using namespace driving_swap;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

template <typename Part>
struct BoxOf final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    return Port::Connect(in, runtime().Create<Part>(*this, "part").in);
  }
};
template <int kUnit>
struct Source final : Module {
  using Module::Module;
  static constexpr const char* kUnits[] = {"km/h", "deg"};
  Output<double> value{this, "value", {.unit = kUnits[kUnit]}};
  void Update() override {}
};
struct Arm final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.unit = "rad", .drives = true, .safe_value = AnyValue(0.3)}};
  void Update() override {}
};
struct Brakes final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(0.0), .brake = 400ms}};
  void Update() override {}
};
/// Two motors behind one port, of which one says its safe value.
struct Two final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    if (auto tied = Port::Connect(in, runtime().Create<Declared<DrivingKind::kVelocity, 0>>(*this, "left").in); !tied) return tied;
    return Port::Connect(in, runtime().Create<Undeclared<1>>(*this, "right").in);
  }
};
struct Apart final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    if (auto tied = Port::Connect(in, runtime().Create<Declared<DrivingKind::kVelocity, 1500>>(*this, "left").in); !tied) return tied;
    return Port::Connect(in, runtime().Create<Declared<DrivingKind::kVelocity, 1520>>(*this, "right").in);
  }
};
struct Ramped final : Module {
  using Module::Module;
  Input<double> in{this, "in"};
  Output<double> out{this, "out"};
  void Update() override {}
};
/// What drives is behind another module.
struct Deep final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    auto& ramp = runtime().Create<Ramped>(*this, "ramp");
    if (auto tied = Port::Connect(in, ramp.in); !tied) return tied;
    return Port::Connect(ramp.out, runtime().Create<Declared<DrivingKind::kVelocity, 0>>(*this, "wheels").in);
  }
};
/// As a plugin that is loaded anew with another unit.
struct Changing final : Module {
  using Module::Module;
  static inline const char* now = "";
  Input<double> in{this, "in", {.unit = now}};
  void Update() override {}
};
/// Of the unit that a parameter says.
struct OfUnit final : Module {
  using Module::Module;
  StaticParameter<std::string> unit{this, "unit", {.default_value = ""}};
  std::optional<Input<double>> in;
  Result<void> Construct() override {
    in.emplace(this, "in", InputOptions{.unit = unit.Get()});
    return {};
  }
  void Update() override {}
};

struct DrivingSwapComposite : DrivingSwap {
  DrivingSwapComposite() {
    shop_.Add<Boxed>("test/boxed");
    shop_.Add<BoxOf<Undeclared<0>>>("test/boxed_number");
    shop_.Add<BoxOf<Declared<DrivingKind::kVelocity, 0>>>("test/boxed_drive");
    shop_.Add<Source<0>>("test/kilometres");
    shop_.Add<Source<1>>("test/degrees");
    shop_.Add<Arm>("test/arm");
    shop_.Add<Two>("test/two");
    shop_.Add<Deep>("test/deep");
    shop_.Add<Brakes>("test/brakes");
    shop_.Add<Changing>("test/changing");
    shop_.Add<OfUnit>("test/of_unit");
  }
  ChangeOutcome Swap(const char* type) { return history_.Apply({ReplaceModule{"/demo/m", type}}); }
  Port& Box() { return shop_.Get<Port>("/demo/m/in"); }
  void Start(Port& at, double value) { ASSERT_TRUE(at.PublishFilled(internal::FillWith(AnyValue(value)))); }
};

TEST_F(DrivingSwapComposite, WhatIsOnlyInheritedIsNoMark) {
  Load("test/esc", "");
  ASSERT_TRUE(Swap("test/boxed_number"));
  EXPECT_TRUE(Box().is_driving());
  ASSERT_TRUE(Swap("test/drive"));
  EXPECT_EQ(ReadUnderStop(), 0);
  ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  Load("test/motor", kMarks[1]);
  ASSERT_TRUE(Swap("test/boxed"));
  ASSERT_TRUE(Swap("test/brakes"));
  EXPECT_EQ(In().stop()->brake(), 400ms);
}

TEST_F(DrivingSwapComposite, WhatIsNotConnectedKeepsItsMarkAndItsBlock) {
  Load("test/motor", kMarks[1]);
  ASSERT_TRUE(history_.Apply({DisconnectPorts{"/demo/s/value", "/demo/m/in"}}));
  ASSERT_TRUE(In().Block());
  ASSERT_TRUE(Swap("test/boxed"));
  EXPECT_TRUE(Box().is_driving());
  EXPECT_TRUE(Box().is_blocked());
}

TEST_F(DrivingSwapComposite, AnUndoLeavesWhatWasSetSince) {
  for (const char* const type : {"test/boxed", "test/two"}) {
    Load("test/motor", "");
    ASSERT_TRUE(Swap(type));
    ASSERT_TRUE(Box().Block() || Box().SetDriving(true, AnyValue(0.0), {}, DrivingKind::kVelocity));
    ASSERT_TRUE(Box().Block());
    ASSERT_TRUE(Box().PublishByHand(internal::FillWith(AnyValue(0.2))));
    ASSERT_TRUE(Box().PublishByHand(internal::FillWith(AnyValue(0.1)), Port::Setter::kRule));
    ASSERT_TRUE(history_.Undo());
    EXPECT_TRUE(In().is_blocked());
    EXPECT_TRUE(In().is_set_by_hand(Port::Setter::kRule));
    EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), 0);
    In().Unblock();
    EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), 0) << "from before the release";
    ASSERT_TRUE(history_.Redo());
    EXPECT_TRUE(Box().is_set_by_hand());
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

// Each part that says nothing itself, too.
TEST_F(DrivingSwapComposite, WhatDroveDrivesInEachPart) {
  Load("test/motor", kMarks[1]);
  ASSERT_TRUE(Swap("test/two"));
  shop_.runtime.robot_stop().Press("a test");
  for (const char* const part : {"left", "right"}) {
    EXPECT_FALSE(internal::PassedStops(shop_.Get<Port>("/demo/m/" + std::string(part) + "/input/in")).empty()) << part;
  }
  ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  ASSERT_TRUE(shop_.runtime.robot_stop().Release("a test"));
  Load("test/esc", "");
  EXPECT_FALSE(Swap("test/two")) << "1500 is not in m/s";
}

// Nor under STOP, on the way back.
TEST_F(DrivingSwapComposite, WhatDroveSomewhereWithinHasToBeDeclared) {
  Load("test/motor", "");
  ASSERT_TRUE(Swap("test/deep"));
  const auto refused = Swap("test/boxed");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("/demo/m/in: something moves by it, and the new module does not say that"));
  EXPECT_TRUE(Swap("test/drive"));
  EXPECT_TRUE(history_.Undo());
  EXPECT_TRUE(Swap("test/deep"));
  EXPECT_TRUE(history_.Undo());
  EXPECT_TRUE(history_.Undo()) << "to the motor";
  ASSERT_TRUE(history_.Redo());
  shop_.runtime.robot_stop().Press("a test");
  EXPECT_FALSE(history_.Undo());
}

TEST_F(DrivingSwapComposite, WhatRestsFartherUpMovesNobodyElse) {
  shop_.Add<Declared<DrivingKind::kVelocity, 1520>>("test/other_esc");
  Load("test/esc", "  <module name=\"right\" type=\"test/esc\"/>\n  <connect from=\"s/value\" to=\"right/in\"/>\n");
  auto& source = shop_.Get<Port>("/demo/s/output/value");
  ASSERT_TRUE(source.PublishByHand(internal::FillWith(AnyValue(1500.)), Port::Setter::kRule));
  const auto refused = Swap("test/other_esc");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("/demo/s/output/value is at rest at 1500, by which others move, too"));
  EXPECT_EQ(shop_.Get<Input<double>>("/demo/right/input/in").Get(), 1500);
  source.Release(Port::Setter::kRule);
  EXPECT_TRUE(Swap("test/other_esc"));
}

TEST_F(DrivingSwapComposite, WhatWasPublishedBeforeAPersonHasReleasedThePartCountsNoMore) {
  Load("test/boxed_drive", "");
  Start(shop_.Get<Port>("/demo/s/output/value"), 0.7);
  ASSERT_TRUE(Box().PublishByHand(internal::FillWith(AnyValue(0.2))));
  ASSERT_TRUE(Box().Release());
  ASSERT_EQ(shop_.Get<Input<double>>("/demo/m/part/input/in").Get(), 0);
  ASSERT_TRUE(Swap("test/number"));
  EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), 0);
}

// A file would connect them without.
TEST_F(DrivingSwapComposite, AConversionByUnitsIsNoneOfAnInterfacePort) {
  Load("test/motor", "", "test/kilometres");
  const auto refused = Swap("test/boxed");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("are converted by their units, which an interface port has not"));
  ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  Load("test/boxed_number", "", "test/kilometres");
  EXPECT_FALSE(Swap("test/motor"));
}

TEST_F(DrivingSwapComposite, ASafeValueBehindAnotherUnitIsNone) {
  Load("test/arm", "", "test/degrees");
  EXPECT_FALSE(SafeValueOf(shop_.Get<Port>("/demo/s/output/value")));
  EXPECT_EQ(Number(*SafeValueOf(In())), 0.3);
}

TEST_F(DrivingSwapComposite, APortOfAPlainGroupGetsNothingByAnotherName) {
  Load("test/motor", "  <group name=\"g\">\n    <port name=\"in\" direction=\"input\" type=\"double\"/>\n    <module name=\"w\" type=\"test/drive\"/>\n    <connect from=\"in\" to=\"w/in\"/>\n  </group>\n  <connect from=\"s/value\" to=\"g/in\"/>\n");
  ASSERT_TRUE(shop_.Get<Port>("/demo/g/in").PublishByHand(internal::FillWith(AnyValue(0.2))));
  ASSERT_TRUE(history_.Apply({RenameElement{"/demo/g", "h"}}));
  EXPECT_TRUE(shop_.Get<Port>("/demo/h/in").is_set_by_hand());
  EXPECT_FALSE(shop_.Get<Port>("/demo/h/in").is_driving());
  EXPECT_EQ(shop_.Get<Port>("/demo/h/in").Sinks().size(), 1U);
}

TEST_F(DrivingSwapComposite, WhatRestsDoesNotGoWhereNothingIsRestForAll) {
  shop_.Add<Apart>("test/apart");
  Load("test/esc", "");
  ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(1500.)), Port::Setter::kRule));
  const auto refused = Swap("test/apart");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("moves several things, whose safe values differ, and /demo/m/input/in is at rest at 1500"));
  EXPECT_TRUE(In().Release(Port::Setter::kRule));
  EXPECT_TRUE(Swap("test/apart"));
}

// Who is put back is refused nothing.
TEST_F(DrivingSwapComposite, WhatRestsMeanwhileStaysWhereOneIsPutBack) {
  struct Failing final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(1500.0)}};
    void Update() override { throw std::runtime_error("no such device"); }
  };
  shop_.Add<Apart>("test/apart");
  shop_.Add<Failing>("test/failing");
  Load("test/apart", "");
  Scheduler scheduler(shop_.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  StructureEditor editor(shop_.runtime, shop_.plugins.modules(), &scheduler);
  ASSERT_TRUE(editor.Apply({ReplaceModule{"/demo/m", "test/failing"}}));
  ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(1500.)), Port::Setter::kRule));
  for (int i = 0; i < 5; ++i) scheduler.Step();
  EXPECT_EQ(FindModuleType(shop_.Get<FrameworkElement>("/demo/m")), "test/apart");
  EXPECT_EQ(Box().incoming().size(), 1U);
  EXPECT_EQ(shop_.Get<Input<double>>("/demo/m/left/input/in").Get(), 1500);
}

TEST_F(DrivingSwapComposite, ABlockOfAPartIsNotLetGoOf) {
  Load("test/two", "");
  const auto expect_refused = [&](const std::string& part) {
    const auto refused = Swap("test/drive");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("/demo/m/" + part + "/input/in: it is held, and the new module has no such port; release it first"));
  };
  auto &left = shop_.Get<Port>("/demo/m/left/input/in"), &right = shop_.Get<Port>("/demo/m/right/input/in");
  ASSERT_TRUE(right.Block());
  expect_refused("right");
  EXPECT_TRUE(right.is_blocked());
  right.Unblock();
  ASSERT_TRUE(left.PublishByHand(internal::FillWith(AnyValue(0.0)), Port::Setter::kRule));
  expect_refused("left");
  EXPECT_TRUE(left.Release(Port::Setter::kRule));
  EXPECT_TRUE(Swap("test/drive"));
}

TEST_F(DrivingSwapComposite, TheWayBackIsNoneIntoAnotherUnit) {
  for (const char* const between : {"test/number", "test/boxed_number"}) {
    Changing::now = "";
    Load("test/changing", "  <driving port=\"m/in\" safe=\"1500\" command=\"velocity\"/>\n");
    ASSERT_TRUE(Swap(between));
    Changing::now = "m/s";
    EXPECT_FALSE(history_.Undo());
    EXPECT_EQ(Number(internal::PassedStops(*(*PathSearch(shop_.Get<FrameworkElement>("/demo/m")).FindPort("in", PathKind::kInput))).front().safe_value), 1500);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

TEST_F(DrivingSwapComposite, NorIsAMarkFartherUpThatOfWhoDeclaresAnother) {
  Load("test/number", "  <driving port=\"s/value\" safe=\"1500\" command=\"velocity\"/>\n");
  struct Metres final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.unit = "m/s", .drives = true}};
    void Update() override {}
  };
  shop_.Add<Metres>("test/metres");
  EXPECT_FALSE(Swap("test/metres"));
  EXPECT_FALSE(Swap("test/boxed"));
}

TEST_F(DrivingSwapComposite, AParameterCutsNothingThatIsMarked) {
  Load("test/of_unit", "  <driving port=\"m/in\" safe=\"1500\" command=\"velocity\"/>\n");
  EXPECT_FALSE(history_.Apply({SetParameter{"/demo/m/unit", "m/s"}}));
  EXPECT_TRUE(In().is_driving());
  EXPECT_EQ(In().incoming().size(), 1U);
}

TEST_F(DrivingSwapComposite, WhatARecordingHasThePlaceOfCannotBeSet) {
  Load("test/number", "  <driving port=\"s/value\" safe=\"0\" command=\"velocity\"/>\n");
  auto& source = shop_.Get<Port>("/demo/s/output/value");
  auto& elsewhere = shop_.runtime.Create<FrameworkElement>(shop_.runtime.root(), "elsewhere");
  const auto output = source.MakeOutput(elsewhere, "played", {});
  output->TakeOver(source);
  EXPECT_FALSE(source.Block());
  EXPECT_FALSE(source.PublishByHand(internal::FillWith(AnyValue(0.0))));
  const auto refused = history_.Apply({ReplaceModule{"/demo/s", "test/source"}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("/demo/s/output/value: nothing reads what it publishes: a recording that is played has its place"));
  source.TakeOver(*output);
  EXPECT_TRUE(source.Block());
}

// Under STOP an undo lets go of nothing. What has no safe value in its unit is not undone.
TEST_F(DrivingSwapComposite, AnUndoUnderStopLetsNothingGo) {
  for (const char* const between : {"test/drive", "test/boxed_number"}) {
    for (const char* const first : {"test/motor", "test/servo"}) {
      const bool is_position = std::string(first) == "test/servo";
      const bool is_marked = std::string(between) != "test/drive";
      if (is_marked && is_position) continue;
      Load(first, is_marked ? kMarks[1] : "");
      ASSERT_TRUE(Swap(between));
      Start(shop_.Get<Port>("/demo/s/output/value"), 0.7);
      shop_.runtime.robot_stop().Press("a test");
      const bool is_undone = bool(history_.Undo());
      EXPECT_EQ(is_undone, !is_position);
      EXPECT_TRUE(!is_undone || dynamic_cast<Input<double>&>(In()).Get() == 0);
      EXPECT_TRUE(shop_.runtime.robot_stop().Release("a test"));
      ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
    }
  }
}

}  // namespace
}  // namespace runnel::testing
