// The same, in the way back, and in files.

#include <chrono>

#include "tests/plugins/application_tags/driving_swap_fixture.h"

namespace runnel::testing {
namespace {

using namespace driving_swap;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

/// As a plugin that is loaded anew with another version of it.
struct Corrected final : Module {
  using Module::Module;
  static inline double safe = 0;
  Input<double> in{this, "in",
                   safe == 0
                       ? InputOptions{}
                       : InputOptions{.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(safe)}};
  void Update() override {}
};

/// As a plugin that is loaded anew with another unit.
struct Changing final : Module {
  using Module::Module;
  static inline const char* now = "";
  Input<double> in{this, "in", {.unit = now}};
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

TEST_F(DrivingSwap, WhereNothingDrivesNothingIsAtRest) {
  shop_.Add<Boxed>("test/boxed");
  shop_.Add<Defaulted>("test/defaulted");
  for (const char* const type : {"test/boxed", "test/motor"}) {
    Load("test/defaulted", "");
    ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(1500.)), Port::Setter::kRule));
    ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", type}}));
    auto& in = **PathSearch(shop_.Get<FrameworkElement>("/demo/m")).FindPort("in", PathKind::kInput);
    EXPECT_EQ(Number(in.ValueByHand(Port::Setter::kRule)->value), 1500);
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
  EXPECT_THAT(refused.diagnostics.ToString(),
              HasSubstr("is in m/s, which is that of a velocity, and is said to be a position"));
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

// What stops its place would mean something else in its unit: the one that has failed stays, and does not run.
TEST_F(DrivingSwap, NoneIsPutBackIntoAStopThatItWouldMoveBy) {
  struct Failing final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(1500.0)}};
    void Update() override { throw std::runtime_error("no such device"); }
  };
  shop_.Add<Failing>("test/failing");
  const auto publish = [this](double value) {
    ASSERT_TRUE(shop_.Get<Port>("/demo/s/output/value").PublishFilled(internal::FillWith(AnyValue(value))));
  };
  for (const bool is_connected : {false, true}) {
    for (const bool is_stop : {false, true}) {
      SCOPED_TRACE(std::string(is_connected ? "connected" : "not connected") + (is_stop ? ", STOP" : ", block"));
      Load("test/servo", "");
      if (!is_connected) {
        ASSERT_TRUE(history_.Apply({DisconnectPorts{"/demo/s/value", "/demo/m/in"}}));
      }
      publish(0.7);
      Scheduler scheduler(shop_.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
      StructureEditor editor(shop_.runtime, shop_.plugins.modules(), &scheduler);
      ASSERT_TRUE(editor.Apply({ReplaceModule{"/demo/m", "test/failing"}}));
      if (is_stop) {
        shop_.runtime.robot_stop().Press("a test");
      } else {
        ASSERT_TRUE(In().Block());
      }
      publish(0.1);
      for (int i = 0; i < 5; ++i) scheduler.Step();
      EXPECT_EQ(FindModuleType(shop_.Get<FrameworkElement>("/demo/m")), "test/failing");
      EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), 1500) << is_stop;
      EXPECT_EQ(In().is_blocked(), !is_stop);
      EXPECT_EQ(bool(shop_.runtime.robot_stop().Release("a test")), is_stop);
      ASSERT_TRUE(editor.Apply({DeleteElement{"/demo"}}));
    }
  }
}

TEST_F(DrivingSwap, AMarkThatIsDeletedIsTold) {
  Load("test/motor", kMarks[1]);
  const auto deleted = history_.Apply({DeleteElement{"/demo/m"}});
  ASSERT_TRUE(deleted);
  EXPECT_THAT(deleted.diagnostics.ToString(), HasSubstr("/demo/m/input/in: its mark as driving goes with it"));
}

TEST_F(DrivingSwap, TheWayBackIsNoneIntoAnotherUnit) {
  shop_.Add<Changing>("test/changing");
  Changing::now = "";
  Load("test/changing", "  <driving port=\"m/in\" safe=\"1500\" command=\"velocity\"/>\n");
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/number"}}));
  Changing::now = "m/s";
  EXPECT_FALSE(history_.Undo());
  EXPECT_EQ(Safe(), 1500);
}

// Under STOP an undo lets go of nothing. What has no safe value in its unit is not undone.
TEST_F(DrivingSwap, AnUndoUnderStopLetsNothingGo) {
  for (const bool is_connected : {false, true}) {
    for (const char* const first : {"test/motor", "test/servo"}) {
      Load(first, "");
      if (!is_connected) {
        ASSERT_TRUE(history_.Apply({DisconnectPorts{"/demo/s/value", "/demo/m/in"}}));
        ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(0.7))));
      }
      ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/drive"}}));
      ASSERT_TRUE(shop_.Get<Port>("/demo/s/output/value").PublishFilled(internal::FillWith(AnyValue(0.7))));
      shop_.runtime.robot_stop().Press("a test");
      EXPECT_EQ(bool(history_.Undo()), first == std::string("test/motor"));
      EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), 0);
      EXPECT_TRUE(shop_.runtime.robot_stop().Release("a test"));
      ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
    }
  }
}

// Each declares what stops it, and nothing goes from the one to the other.
TEST_F(DrivingSwap, AMotorThatIsNotConnectedIsSwappedUnderStop) {
  struct Kilometres final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.unit = "km/h", .drives = true}};
    void Update() override {}
  };
  struct Metres final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.unit = "m/s", .drives = true}};
    void Update() override {}
  };
  shop_.Add<Kilometres>("test/kilometres");
  shop_.Add<Metres>("test/metres");
  Load("test/metres", "");
  ASSERT_TRUE(history_.Apply({DisconnectPorts{"/demo/s/value", "/demo/m/in"}}));
  shop_.runtime.robot_stop().Press("a test");
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/kilometres"}}));
  EXPECT_TRUE(In().is_driving());
  EXPECT_TRUE(history_.Undo());
  EXPECT_TRUE(In().is_driving());
}

}  // namespace
}  // namespace runnel::testing
