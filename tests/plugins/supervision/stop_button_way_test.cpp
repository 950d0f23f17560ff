// What a stop button does when nobody can press by it any more.

#include <algorithm>
#include <utility>

#include "core/port/proxy_port.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/structure/value_by_hand.h"
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

// Who looks how old it is says 0 then.
TEST_F(WayToStopButton, WhatIsLostIsNotLetGo) {
  auto& debouncing = runtime.Create<Debouncing<Ageing::kTimesOut>>(app, "debouncing");
  MustSucceed(Port::Connect(panel.out, debouncing.in));
  MustSucceed(runtime.MakeReady(runtime.root()));
  MustSucceed(supervisor.Add(StopButtonRule{debouncing.out.path(), true}));
  debouncing.out.Publish(1);
  WaitForStop("the button /app/debouncing/output/out");
  MustSucceed(supervisor.SetPaused("/app/panel", true));
  WaitUntil("it is pressed once more", [&] { return runtime.robot_stop().state().requests > 1; });
  debouncing.out.Publish(0);
  std::this_thread::sleep_for(200ms);  // it is not told that it does nothing
  EXPECT_TRUE(runtime.robot_stop().in_force());
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
  return std::ranges::any_of(supervisor.TakeNotices(), [&](const Notice& each) { return each.message.find(words) != std::string::npos; });
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
  WaitUntil("it is told", [&] { return IsTold(supervisor, "does not release the STOP"); });
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

/// Says what has changed, and 0 when nothing comes any more.
struct OnChange final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.ageing = Ageing::kTimesOut}};
  Output<double> out{this, "out"};
  InputTimeout in_timeout{this, in, {}};
  bool last = false;
  void Update() override {
    const auto read = in_timeout.Read(in, now());
    const bool is_down = read && *read != 0;
    if (std::exchange(last, is_down) != is_down) out.Publish(is_down ? 1 : 0);
  }
};

// It is held down, and says so again and again, until its cable is pulled.
TEST_F(WayToStopButton, WhatIsStillDownFartherUpIsNotLetGo) {
  auto& debouncing = runtime.Create<OnChange>(app, "debouncing");
  MustSucceed(Port::Connect(panel.out, debouncing.in));
  MustSucceed(runtime.MakeReady(runtime.root()));
  MustSucceed(supervisor.Add(StopButtonRule{debouncing.out.path(), true}));
  panel.action = [](Doing&) {};
  Time at = runtime.clock().Now();
  for (int i = 0; i < 10; ++i) {
    panel.out.Publish(1);
    (void)scheduler.RunUntil(at += 100ms);
  }
  WaitForStop("the button");
  (void)scheduler.RunUntil(at += 2s);
  WaitUntil("it is told", [&] { return IsTold(supervisor, "/app/debouncing/input/in is not let go"); });
  EXPECT_TRUE(runtime.robot_stop().in_force());
  panel.out.Publish(1);
  (void)scheduler.RunUntil(at += 100ms);
  panel.out.Publish(0);
  (void)scheduler.RunUntil(at += 100ms);
  WaitUntil("it is released", [&] { return !runtime.robot_stop().in_force(); });
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

TEST_F(WayToStopButton, NorIsWhatIsStillDownAsAPartOfAMessage) {
  auto& gamepad = runtime.Create<GamepadDriver>(app, "gamepad");
  auto& debouncing = runtime.Create<OnChange>(app, "debouncing");
  MustSucceed(Port::Connect(gamepad.out, debouncing.in, {.part = "button"}));
  MustSucceed(runtime.MakeReady(runtime.root()));
  MustSucceed(supervisor.Add(StopButtonRule{debouncing.out.path(), true}));
  Time at = runtime.clock().Now();
  for (int i = 0; i < 10; ++i) {
    gamepad.out.Publish({0, 1});
    (void)scheduler.RunUntil(at += 100ms);
  }
  WaitForStop("the button");
  (void)scheduler.RunUntil(at += 2s);
  WaitUntil("it is told", [&] { return IsTold(supervisor, "is not let go"); });
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

// Which of them was let go, nobody can tell.
TEST_F(WayToStopButton, OfSeveralThatComeTogetherNoneReleases) {
  auto& rear = runtime.Create<Doing>(app, "rear");
  MustSucceed(runtime.MakeReady(runtime.root()));
  auto& port = runtime.Create<ProxyPort>(app, "stop", Port::Direction::kOutput, TypeOf<double>());
  MustSucceed(Port::Connect(panel.out, port));
  MustSucceed(Port::Connect(rear.out, port));
  MustSucceed(supervisor.Add(StopButtonRule{port.path(), true}));
  rear.out.Publish(1);
  WaitForStop("the button");
  const Time at = runtime.clock().Now();
  (void)scheduler.RunUntil(at + 1s);
  panel.out.Publish(0);  // as one that is up says again and again
  WaitUntil("it is told", [&] { return IsTold(supervisor, "does not release the STOP"); });
  const auto requests = runtime.robot_stop().requests();
  for (int i = 0; i < 10; ++i) {
    panel.out.Publish(0);
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_FALSE(IsTold(supervisor, "is not let go")) << "told once is enough";
  EXPECT_EQ(runtime.robot_stop().requests(), requests);
  (void)scheduler.RunUntil(at + 2s);
  rear.out.Publish(0);
  WaitUntil("it is told", [&] { return IsTold(supervisor, "several buttons press by /app/stop"); });
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

// As a rule does that switches to the rear one when the front one's cable is pulled.
TEST_F(WayToStopButton, WhatIsConnectedAnewReleasesNothing) {
  auto& rear = runtime.Create<Doing>(app, "rear");
  auto& debouncing = runtime.Create<OnChange>(app, "debouncing");
  rear.action = [](Doing&) {};
  panel.action = rear.action;
  MustSucceed(runtime.MakeReady(runtime.root()));
  MustSucceed(Port::Connect(panel.out, debouncing.in));
  MustSucceed(supervisor.Add(StopButtonRule{debouncing.out.path(), true}));
  Time at = runtime.clock().Now();
  panel.out.Publish(1);
  (void)scheduler.RunUntil(at += 100ms);
  WaitForStop("the button");
  {
    const std::lock_guard lock(runtime.structure_mutex());
    MustSucceed(Port::Disconnect(panel.out, debouncing.in));
    MustSucceed(Port::Connect(rear.out, debouncing.in));
  }
  (void)scheduler.RunUntil(at += 100ms);
  rear.out.Publish(0);
  (void)scheduler.RunUntil(at += 100ms);
  WaitUntil("it is told", [&] { return IsTold(supervisor, "does not release the STOP, as what is connected on its way has changed"); });
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

TEST_F(WayToStopButton, ItPressesWhenARuleSetsIt) {
  Add(panel.out);
  MustSucceed(panel.out.PublishByHand([](void* value) -> Result<void> { return *static_cast<double*>(value) = 0, Result<void>(); }, Port::Setter::kRule));
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
  ASSERT_TRUE(runtime.robot_stop().Release("the test"));
  const auto pressed = runtime.robot_stop().state().changes;
  WaitUntil("it is pressed again", [&] { return runtime.robot_stop().state().changes > pressed; });
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
