// What a stop button does when nobody can press by it any more.

#include <algorithm>
#include <utility>

#include "core/port/proxy_port.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/supervision/notices.h"
#include "tests/plugins/supervision/stop_button_fixture.h"

namespace runnel::testing {
namespace {

/// Passes on what comes to it, as what keeps a switch from bouncing does.
template <Ageing kAgeing>
struct Debouncing final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.ageing = kAgeing}};
  Output<double> out{this, "out"};
  void Update() override {}
};

class WayToStopButton : public StopButtonTest {
 protected:
  template <Ageing kAgeing>
  Debouncing<kAgeing>& Debounced() {
    auto& debouncing = runtime.Create<Debouncing<kAgeing>>(app, "debouncing");
    MustSucceed(Port::Connect(panel.out, debouncing.in));
    MustSucceed(runtime.MakeReady(runtime.root()));
    Add(debouncing.out);
    return debouncing;
  }
  /// It is known once it has been looked at: what is pressed from then on is news.
  void Add(const Port& port) {
    MustSucceed(supervisor.Add(StopButtonRule{port.path()}));
    panel.out.Publish(0);
    std::this_thread::sleep_for(200ms);
    ASSERT_FALSE(runtime.robot_stop().in_force());
  }
  void SetByHand(Port& port) {
    const double up = 0;
    const std::lock_guard lock(runtime.structure_mutex());
    MustSucceed(PublishByHand(port, &up));
  }
};

TEST_F(WayToStopButton, ItPressesWhenItsModuleDoesNotRun) {
  Add(panel.out);
  MustSucceed(supervisor.SetPaused("/app/panel", true));
  WaitForStop("/app/panel is paused");
  ASSERT_TRUE(runtime.robot_stop().Release("the test")) << "it is told once";
}

// Also of one that speaks only when it changes, and so says nothing when it goes on.
TEST_F(WayToStopButton, ItPressesEachTimeThatItsModuleIsPaused) {
  Add(panel.out);
  for (int i = 0; i < 2; ++i) {
    MustSucceed(supervisor.SetPaused("/app/panel", true));
    WaitForStop("/app/panel is paused");
    MustSucceed(supervisor.SetPaused("/app/panel", false));
    std::this_thread::sleep_for(200ms);  // it is not told that it runs again
    ASSERT_TRUE(runtime.robot_stop().Release("the test"));
  }
}

TEST_F(WayToStopButton, WhatElseItsModuleReadsIsNoButton) {
  struct Panel final : Module {
    using Module::Module;
    Input<double> lamp{this, "lamp"};
    Output<double> out{this, "out"};
    void Update() override {}
  };
  auto& desk = runtime.Create<Panel>(app, "desk");
  MustSucceed(Port::Connect(panel.out, desk.lamp));
  MustSucceed(runtime.MakeReady(runtime.root()));
  Add(desk.out);
  MustSucceed(supervisor.SetPaused("/app/panel", true));
  std::this_thread::sleep_for(200ms);
  EXPECT_FALSE(runtime.robot_stop().in_force()) << runtime.robot_stop().state().by;
  MustSucceed(supervisor.SetPaused("/app/desk", true));
  WaitForStop("/app/desk is paused");
}

TEST_F(WayToStopButton, ItPressesWhenWhatComesBeforeItsModuleDoesNotRun) {
  (void)Debounced<Ageing::kPassedOn>();
  MustSucceed(supervisor.SetPaused("/app/panel", true));
  WaitForStop("/app/panel is paused");
}

TEST_F(WayToStopButton, AlsoOverOneThatLooksHowOldItIs) {
  (void)Debounced<Ageing::kTimesOut>();
  MustSucceed(supervisor.SetPaused("/app/panel", true));
  WaitForStop("/app/panel is paused");
}

TEST_F(WayToStopButton, ItPressesWhenWhatComesBeforeItIsCutOff) {
  auto& debouncing = Debounced<Ageing::kPassedOn>();
  MustSucceed(Port::Disconnect(panel.out, debouncing.in));
  WaitForStop("nothing is connected to /app/debouncing/input/in");
}

TEST_F(WayToStopButton, ItPressesWhenWhatComesBeforeItIsSetByHand) {
  SetByHand(Debounced<Ageing::kPassedOn>().in);
  WaitForStop("/app/debouncing/input/in is set by hand");
}

// As by a cable that is pulled: its module runs, and says nothing.
TEST_F(WayToStopButton, WhatComesOfATimeOutIsNotLetGo) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path(), true}));
  const Time pressed = runtime.clock().Now();
  panel.out.Publish(1, pressed);
  WaitForStop("the button /app/panel/output/out");
  (void)scheduler.RunUntil(pressed + 1s);
  panel.out.Publish(0, pressed);
  std::this_thread::sleep_for(200ms);  // it is not told that it does nothing
  ASSERT_TRUE(runtime.robot_stop().in_force());
  panel.out.Publish(1);
  panel.out.Publish(0);
  WaitUntil("it is released", [&] { return !runtime.robot_stop().in_force(); });
}

/// Whether of what has been told since it was asked last something has these words in it.
bool IsTold(Supervisor& supervisor, std::string_view words) {
  return std::ranges::any_of(test::NoticesOf(supervisor),
                             [&](const Notice& each) { return each.message.find(words) != std::string::npos; });
}

// A driver whose stamps are coarse, or whose module has read something slow as well.
TEST_F(WayToStopButton, WhatBearsTheTimeOfThePressReleasesNothingAndIsTold) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path(), true}));
  const Time pressed = runtime.clock().Now();
  panel.out.Publish(1, pressed);
  WaitForStop("the button /app/panel/output/out");
  (void)scheduler.RunUntil(pressed + 1s);
  panel.out.Publish(0, pressed);
  WaitUntil("it is told", [&] { return IsTold(supervisor, "does not release the STOP"); });
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

TEST_F(WayToStopButton, NorIsWhatComesOfATimeOutAfterABurst) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path(), true}));
  const Time pressed = runtime.clock().Now();
  for (int i = 0; i < 3000; ++i) panel.out.Publish(0);  // the queue has no room for what counts
  panel.out.Publish(1, pressed);
  WaitForStop("the button");
  (void)scheduler.RunUntil(pressed + 1s);
  panel.out.Publish(0, pressed);
  std::this_thread::sleep_for(200ms);  // nobody knows whether it was the last press that was let go
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

struct Gamepad {
  double stick = 0;
  double button = 0;
};
void Describe(TypeBuilder<Gamepad>& type) {
  type.Name("Gamepad").Field("stick", &Gamepad::stick).Field("button", &Gamepad::button);
}
struct GamepadDriver final : Module {
  using Module::Module;
  Output<Gamepad> out{this, "out"};
  void Update() override {}
};

// What is made of something else may be 0 as that was lost.
TEST_F(WayToStopButton, ItReleasesOnlyAtTheOutputOfItsOwnDriver) {
  const auto refusal = [&](const Port& port) {
    const auto added = supervisor.Add(StopButtonRule{port.path(), true});
    return added ? "" : added.error().ToString();
  };
  auto& aged = runtime.Create<Debouncing<Ageing::kTimesOut>>(app, "aged");
  auto& passed = runtime.Create<Debouncing<Ageing::kPassedOn>>(app, "passed");
  auto& silent = runtime.Create<Debouncing<Ageing::kUnspecified>>(app, "silent");
  auto& mode = runtime.Create<Debouncing<Ageing::kSetOnce>>(app, "mode");
  for (Port* const each : {static_cast<Port*>(&aged.in), static_cast<Port*>(&passed.in), static_cast<Port*>(&silent.in),
                           static_cast<Port*>(&mode.in)}) {
    MustSucceed(Port::Connect(panel.out, *each));
  }
  MustSucceed(runtime.MakeReady(runtime.root()));
  EXPECT_THAT(refusal(aged.out),
              HasSubstr("/app/aged/output/out: cannot release the STOP, as its module makes it of /app/aged/input/in"));
  EXPECT_THAT(refusal(passed.out), HasSubstr("makes it of"));
  EXPECT_THAT(refusal(silent.out), HasSubstr("makes it of"));
  EXPECT_EQ(refusal(mode.out), "");
  auto& gamepad = runtime.Create<GamepadDriver>(app, "gamepad");
  auto& part = runtime.Create<ProxyPort>(app, "part", Port::Direction::kOutput, TypeOf<double>());
  MustSucceed(Port::Connect(gamepad.out, part, {.part = "button"}));
  EXPECT_THAT(refusal(part), HasSubstr("converted"));
  auto& both = runtime.Create<ProxyPort>(app, "both", Port::Direction::kOutput, TypeOf<double>());
  MustSucceed(Port::Connect(panel.out, both));
  EXPECT_EQ(refusal(both), "");
  MustSucceed(Port::Connect(mode.out, both));
  EXPECT_THAT(refusal(both), HasSubstr("/app/both: cannot release the STOP, as several buttons press by it"));
}

// Which of them was let go, nobody can tell.
TEST_F(WayToStopButton, WhereAnotherOneIsConnectedLaterNoneReleases) {
  auto& rear = runtime.Create<Doing>(app, "rear");
  MustSucceed(runtime.MakeReady(runtime.root()));
  auto& port = runtime.Create<ProxyPort>(app, "stop", Port::Direction::kOutput, TypeOf<double>());
  MustSucceed(Port::Connect(panel.out, port));
  MustSucceed(supervisor.Add(StopButtonRule{port.path(), true}));
  MustSucceed(Port::Connect(rear.out, port));
  rear.out.Publish(1);
  WaitForStop("the button");
  std::this_thread::sleep_for(200ms);  // until it is known that they are two
  panel.out.Publish(0);                // as one that is up says again and again
  WaitUntil("it is told", [&] {
    (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
    rear.out.Publish(1);
    (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
    rear.out.Publish(0);
    std::this_thread::sleep_for(200ms);  // another reason may have been told first, of a machine that is held up
    return IsTold(supervisor, "does not release the STOP, as /app/stop cannot release the STOP, as several buttons");
  });
  const auto requests = runtime.robot_stop().requests();
  for (int i = 0; i < 10; ++i) {
    rear.out.Publish(1);
    panel.out.Publish(0);
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_FALSE(IsTold(supervisor, "several buttons")) << "told once is enough";
  EXPECT_GT(runtime.robot_stop().requests(), requests);
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

// As a rule does that switches to the rear one when the front one's cable is pulled.
TEST_F(WayToStopButton, WhatIsConnectedAnewReleasesNothing) {
  auto& rear = runtime.Create<Doing>(app, "rear");
  MustSucceed(runtime.MakeReady(runtime.root()));
  auto& port = runtime.Create<ProxyPort>(app, "stop", Port::Direction::kOutput, TypeOf<double>());
  MustSucceed(Port::Connect(panel.out, port));
  MustSucceed(supervisor.Add(StopButtonRule{port.path(), true}));
  panel.out.Publish(1);
  WaitForStop("the button");
  {
    const std::lock_guard lock(runtime.structure_mutex());
    MustSucceed(Port::Disconnect(panel.out, port));
    MustSucceed(Port::Connect(rear.out, port));
    rear.out.Publish(0);
  }
  std::this_thread::sleep_for(200ms);  // it need not be told that it does nothing
  EXPECT_TRUE(runtime.robot_stop().in_force());
  (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
  rear.out.Publish(1);
  rear.out.Publish(0);
  WaitUntil("it is released", [&] { return !runtime.robot_stop().in_force(); });
}

TEST_F(WayToStopButton, ItPressesWhenARuleSetsIt) {
  Add(panel.out);
  MustSucceed(panel.out.PublishByHand(
      [](void* value) -> Result<void> { return *static_cast<double*>(value) = 0, Result<void>(); },
      Port::Setter::kRule));
  WaitForStop("/app/panel/output/out is set by hand, or by a rule");
}

struct Choice final : Module {
  using Module::Module;
  Input<double> front{this, "front", {.ageing = Ageing::kPassedOn}};
  Input<double> rear{this, "rear", {.ageing = Ageing::kPassedOn}};
  Input<double> none{this, "none", {.ageing = Ageing::kPassedOn}};
  Output<double> out{this, "out"};
  void Update() override {}
};

// The third input was never connected, and so is no button.
TEST_F(WayToStopButton, ItPressesWhenOneOfTwoButtonsIsLost) {
  auto& choice = runtime.Create<Choice>(app, "choice");
  auto& rear = runtime.Create<Doing>(app, "rear");
  MustSucceed(Port::Connect(panel.out, choice.front));
  MustSucceed(Port::Connect(rear.out, choice.rear));
  MustSucceed(runtime.MakeReady(runtime.root()));
  Add(choice.out);
  MustSucceed(Port::Disconnect(rear.out, choice.rear));
  WaitForStop("nothing is connected to /app/choice/input/rear");
  MustSucceed(Port::Connect(rear.out, choice.front));
  ASSERT_TRUE(runtime.robot_stop().Release("the test"));
  std::this_thread::sleep_for(200ms);  // nobody is told that it has been found
  MustSucceed(Port::Disconnect(rear.out, choice.front));
  WaitForStop("1 of 2 connections to /app/choice/input/front are gone");
}

TEST_F(WayToStopButton, WhileItIsDownItPressesAgainAlsoWhenAnotherOneIsSetByHand) {
  auto& choice = runtime.Create<Choice>(app, "choice");
  MustSucceed(Port::Connect(panel.out, choice.front));
  MustSucceed(runtime.MakeReady(runtime.root()));
  Add(choice.out);
  SetByHand(choice.front);
  WaitForStop("/app/choice/input/front is set by hand");
  choice.out.Publish(1);
  WaitForStop("the button /app/choice/output/out, as");
  const auto pressed = runtime.robot_stop().state().changes;
  ASSERT_TRUE(runtime.robot_stop().Release("the test"));
  WaitUntil("it is pressed again", [&] { return runtime.robot_stop().state().changes >= pressed + 2; });
}

TEST_F(WayToStopButton, ItPressesWhenItIsSetByHand) {
  Add(panel.out);
  SetByHand(panel.out);
  WaitForStop("the button /app/panel/output/out, as /app/panel/output/out is set by hand");
}

TEST_F(WayToStopButton, ItPressesBehindAnInterfacePort) {
  auto& port = runtime.Create<ProxyPort>(app, "stop", Port::Direction::kOutput, TypeOf<double>());
  MustSucceed(Port::Connect(panel.out, port));
  Add(port);
  SetByHand(panel.out);
  WaitForStop("/app/panel/output/out is set by hand");
  panel.out.Release();
  ASSERT_TRUE(runtime.robot_stop().Release("the test"));
  MustSucceed(Port::Disconnect(panel.out, port));
  WaitForStop("nothing is connected to " + port.path());
}

}  // namespace
}  // namespace runnel::testing
