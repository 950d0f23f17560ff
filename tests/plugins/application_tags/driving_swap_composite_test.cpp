// What the tables of swaps do not see: composites in a row, units that change, ports farther up, and places that a recording has.

#include "plugins/parameters/parameter.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/driving_swap_fixture.h"

namespace runnel::testing {
namespace {

using namespace driving_swap;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

struct Brakes final : Module {
  using Module::Module;
  Input<double> in{
      this, "in", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(0.0), .brake = 400ms}};
  void Update() override {}
};
/// Two motors behind one port, of which one says its safe value.
struct Two final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    if (auto tied = Port::Connect(in, runtime().Create<Declared<DrivingKind::kVelocity, 0>>(*this, "left").in); !tied)
      return tied;
    return Port::Connect(in, runtime().Create<Undeclared<1>>(*this, "right").in);
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
    shop_.Add<BoxOf<Declared<DrivingKind::kVelocity, 0>, 1>>("test/other_boxed_drive");
    shop_.Add<BoxOf<Brakes>>("test/boxed_brakes");
    shop_.Add<Two>("test/two");
    shop_.Add<Deep>("test/deep");
    shop_.Add<OfUnit>("test/of_unit");
  }
  ChangeOutcome Swap(const char* type) { return history_.Apply({ReplaceModule{"/demo/m", type}}); }
  Port& Box() { return shop_.Get<Port>("/demo/m/in"); }
  void Start(Port& at, double value) { ASSERT_TRUE(at.PublishFilled(internal::FillWith(AnyValue(value)))); }
};

// What stops and holds that would have no place there, or another meaning.
TEST_F(DrivingSwapComposite, WhereSomethingMovesOnlyTheSameTakesItsPlace) {
  struct Trial {
    const char *first, *mark, *second, *says;
  };
  constexpr const char* kOther =
      "a composite gives its place only to another one in which the same moves by ports of the same names";
  const std::string pulse = "  <driving port=\"m/in\" safe=\"0\" command=\"velocity\"/>\n";
  for (const Trial& each : {
           Trial{"test/esc", "", "test/boxed_number",
                 "/demo/m/in: moves nothing, or not in the same way as /demo/m/input/in"},
           {"test/motor", kMarks[1], "test/boxed", "not in the same way"},
           {"test/number", "", "test/boxed_drive", kOther},
           {"test/boxed_drive", "", "test/drive",
            "/demo/m/input/in: moves nothing, or not in the same way as /demo/m/in"},
           {"test/boxed_drive", "", "test/boxed_number", kOther},
           {"test/boxed_number", "", "test/boxed_drive", kOther},
           {"test/boxed_drive", "", "test/boxed_brakes", kOther},
           {"test/boxed_drive", "", "test/deep", kOther},
           {"test/deep", "", "test/two", kOther},
           {"test/boxed_number", pulse.c_str(), "test/number", "not in the same way"},
       }) {
    SCOPED_TRACE(std::string(each.first) + " -> " + each.second);
    Load(each.first, each.mark);
    const auto refused = Swap(each.second);
    EXPECT_FALSE(refused);
    EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr(each.says));
    EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("and create the other"));
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
  for (const auto& [first, second] : {std::pair{"test/boxed_drive", "test/other_boxed_drive"},
                                      {"test/deep", "test/deep"},
                                      {"test/two", "test/two"}}) {
    Load(first, "");
    EXPECT_TRUE(Swap(second));
    EXPECT_TRUE(history_.Undo());
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

// A ramp before it would make something else of where it is at rest.
TEST_F(DrivingSwapComposite, NorDoesItMoveByAnotherWay) {
  struct Straight final : Group {
    using Group::Group;
    Result<void> Construct() override {
      auto& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
      return Port::Connect(in, runtime().Create<Declared<DrivingKind::kVelocity, 0>>(*this, "wheels").in);
    }
  };
  shop_.Add<Straight>("test/straight");
  Load("test/deep", "");
  const auto refused = Swap("test/straight");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr("/demo/m/in: something moves by it"));
}

TEST_F(DrivingSwapComposite, AMarkOfAnInterfacePortGoesAlong) {
  Load("test/boxed", "  <driving port=\"m/in\" safe=\"0\" brake=\"0.4 s\" command=\"velocity\"/>\n");
  shop_.Add<BoxOf<Undeclared<1>>>("test/other_boxed");
  ASSERT_TRUE(Box().Block());
  EXPECT_FALSE(Swap("test/boxed_number")) << "which is in no unit";
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(Swap("test/boxed"));
    EXPECT_EQ(Box().stop()->brake(), 400ms);
    EXPECT_TRUE(Box().is_blocked());
  }
  EXPECT_TRUE(history_.Undo());
  EXPECT_TRUE(Box().is_driving());
}

TEST_F(DrivingSwapComposite, AnUndoLeavesWhatWasSetSince) {
  Load("test/motor", "");
  ASSERT_TRUE(Swap("test/boxed"));
  ASSERT_TRUE(Box().PublishByHand(internal::FillWith(AnyValue(0.2))));
  ASSERT_TRUE(Box().PublishByHand(internal::FillWith(AnyValue(0.1)), Port::Setter::kRule));
  ASSERT_TRUE(history_.Undo());
  EXPECT_TRUE(In().is_set_by_hand(Port::Setter::kRule));
  EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), 0.2);
  ASSERT_TRUE(history_.Redo());
  EXPECT_TRUE(Box().is_set_by_hand());
}

TEST_F(DrivingSwapComposite, WhatRestsFartherUpMovesNobodyElse) {
  shop_.Add<Declared<DrivingKind::kVelocity, 1520>>("test/other_esc");
  Load("test/esc", "  <module name=\"right\" type=\"test/esc\"/>\n  <connect from=\"s/value\" to=\"right/in\"/>\n");
  auto& source = shop_.Get<Port>("/demo/s/output/value");
  ASSERT_TRUE(source.PublishByHand(internal::FillWith(AnyValue(1500.)), Port::Setter::kRule));
  const auto refused = Swap("test/other_esc");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(),
              HasSubstr("/demo/s/output/value is at rest at 1500, by which others move, too"));
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
  ASSERT_TRUE(Swap("test/other_boxed_drive"));
  EXPECT_EQ(shop_.Get<Input<double>>("/demo/m/part/input/in").Get(), 0);
  Start(shop_.Get<Port>("/demo/s/output/value"), 0.6);
  EXPECT_EQ(shop_.Get<Input<double>>("/demo/m/part/input/in").Get(), 0.6);
}

TEST_F(DrivingSwapComposite, APartThatTheApplicationHasMarkedMovesInTheNextOneToo) {
  Load("test/boxed_number", "  <driving port=\"m/part/in\" safe=\"0\" command=\"velocity\"/>\n");
  ASSERT_TRUE(Swap("test/boxed_number"));
  ASSERT_TRUE(history_.Apply({RenameElement{"/demo/m", "n"}}));
  EXPECT_TRUE(shop_.Get<Port>("/demo/n/part/input/in").is_driving());
  EXPECT_TRUE(history_.Undo());
  EXPECT_TRUE(history_.Undo());
  EXPECT_TRUE(shop_.Get<Port>("/demo/m/part/input/in").is_driving());
}

TEST_F(DrivingSwapComposite, APortOfAPlainGroupGetsNothingByAnotherName) {
  Load("test/motor",
       "  <group name=\"g\">\n    <port name=\"in\" direction=\"input\" type=\"double\"/>\n    <module name=\"w\" "
       "type=\"test/drive\"/>\n    <connect from=\"in\" to=\"w/in\"/>\n  </group>\n  <connect from=\"s/value\" "
       "to=\"g/in\"/>\n");
  ASSERT_TRUE(shop_.Get<Port>("/demo/g/in").PublishByHand(internal::FillWith(AnyValue(0.2))));
  ASSERT_TRUE(history_.Apply({RenameElement{"/demo/g", "h"}}));
  EXPECT_TRUE(shop_.Get<Port>("/demo/h/in").is_set_by_hand());
  EXPECT_FALSE(shop_.Get<Port>("/demo/h/in").is_driving());
  EXPECT_EQ(shop_.Get<Port>("/demo/h/in").Sinks().size(), 1U);
}

// Who is put back is refused nothing.
TEST_F(DrivingSwapComposite, WhatIsSetMeanwhileStaysWhereOneIsPutBack) {
  struct Failing final : Module {
    using Module::Module;
    Input<double> in{this, "in"};
    void Update() override { throw std::runtime_error("no such device"); }
  };
  shop_.Add<Failing>("test/failing");
  Load("test/boxed_number", "");
  Scheduler scheduler(shop_.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  StructureEditor editor(shop_.runtime, shop_.plugins.modules(), &scheduler);
  ASSERT_TRUE(editor.Apply({ReplaceModule{"/demo/m", "test/failing"}}));
  ASSERT_TRUE(In().SetDriving(true, AnyValue(1500.), {}, DrivingKind::kVelocity));
  ASSERT_TRUE(In().Block());
  ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(0.3)), Port::Setter::kRule));
  for (int i = 0; i < 5; ++i) scheduler.Step();
  EXPECT_EQ(FindModuleType(shop_.Get<FrameworkElement>("/demo/m")), "test/boxed_number");
  EXPECT_EQ(Box().incoming().size(), 1U);
  EXPECT_EQ(shop_.Get<Input<double>>("/demo/m/part/input/in").Get(), 1500);
  EXPECT_TRUE(Box().is_driving());
}

TEST_F(DrivingSwapComposite, WhatIsHeldInAPartIsNotLetGoOf) {
  Load("test/boxed", "");
  auto& part = shop_.Get<Port>("/demo/m/motor/input/in");
  const auto expect_refused = [&] {
    const auto refused = Swap("test/motor");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.diagnostics.ToString(),
                HasSubstr("/demo/m/motor/input/in: it is held, and the new module has no such port; release it first"));
  };
  ASSERT_TRUE(part.Block());
  expect_refused();
  EXPECT_TRUE(part.is_blocked());
  part.Unblock();
  for (const auto setter : {Port::Setter::kPerson, Port::Setter::kRule}) {
    ASSERT_TRUE(part.PublishByHand(internal::FillWith(AnyValue(0.0)), setter));
    expect_refused();
    EXPECT_TRUE(part.Release(setter));
  }
  EXPECT_TRUE(Swap("test/motor"));
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
  EXPECT_THAT(
      refused.diagnostics.ToString(),
      HasSubstr("/demo/s/output/value: nothing reads what it publishes: a recording that is played has its place"));
  source.TakeOver(*output);
  EXPECT_TRUE(source.Block());
}

}  // namespace
}  // namespace runnel::testing
