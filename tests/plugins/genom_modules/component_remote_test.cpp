// Components that call each other's services: one whose codels are in C, and one in C++, in threads of one application.

#include "core/module/kept_state.h"
#include "core/plugin/plugin_manager.h"
#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/genom_modules/component_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

constexpr std::chrono::seconds kLongEnough{100};

class ComponentRemoteTest : public ComponentTest {
 protected:
  ComponentRemoteTest() {
    rig.runtime.set_clock(clock_);
    plugins_.AddSearchFolder(RUNNEL_TEST_PLUGIN_FOLDER);
    EXPECT_TRUE(plugins_.Load("mill"));
    mill_ = *plugins_.modules().Create("mill/mill", rig.runtime.root(), "mill");
    AssignThread(rig.module, CreateThread(rig.runtime, "one", {.period = 10ms}));
    AssignThread(*mill_, CreateThread(rig.runtime, "other", {.period = 10ms}));
  }
  void Start() {
    scheduler_ = std::make_unique<Scheduler>(rig.runtime);
    ASSERT_TRUE(rig.Prepare());
    ASSERT_TRUE(rig.runtime.MakeReady(*mill_));
    ASSERT_TRUE(scheduler_->Start());
  }
  void TearDown() override {
    if (scheduler_ == nullptr) return;
    scheduler_->Stop();
    EXPECT_TRUE(scheduler_->TakeFaults().empty());
  }
  std::string Answer(FrameworkElement& module, const std::string& service, const std::string& arguments) {
    Callable& callable = *PortOf(module, service).FindAnnotation<Callable>();
    const auto call = callable.NewCall();
    EXPECT_TRUE(SetFromText(*callable.arguments(), arguments, call->arguments()));
    EXPECT_EQ(call->Begin(clock_.Now(), kLongEnough), CallStatus::kPending);
    WaitUntil(
        "it is answered", [&] { return call->Poll(clock_.Now()) != CallStatus::kPending; }, kLongEnough);
    return call->Poll(clock_.Now()) == CallStatus::kAnswered ? ToText(*callable.reply(), call->reply()) : call->error();
  }

  static const SteadyClock clock_;  // outlives the rig
  PluginManager plugins_;
  FrameworkElement* mill_ = nullptr;
  std::unique_ptr<Scheduler> scheduler_;
};
const SteadyClock ComponentRemoteTest::clock_;

TEST_F(ComponentRemoteTest, CallsTheServiceThatItIsConnectedWith) {
  ASSERT_TRUE(Port::Connect(PortOf(*mill_, "beep"), PortAt("beep")));
  ASSERT_TRUE(Port::Connect(PortAt("sum"), PortOf(*mill_, "sum")));
  Start();
  EXPECT_EQ(Answer(rig.module, "ask", "{times: 3}"), "6") << "in C, of one in C++";
  EXPECT_EQ(Answer(*mill_, "add", "{name: map, values: [1, 2]}"), "{total: 103, which: right, text: \"the map\"}")
      << "in C++, of one in C, with several outputs";
}

TEST_F(ComponentRemoteTest, GetsTheExceptionsOfTheOther) {
  ASSERT_TRUE(Port::Connect(PortOf(*mill_, "beep"), PortAt("beep")));
  Start();
  EXPECT_EQ(Answer(rig.module, "ask", "{times: 11}"), "beeper::tired {which: right, limit: 11}");
  EXPECT_EQ(Answer(rig.module, "ask", "{times: 200}"), "genom::mwerr {what: \"mill::worn\"}")
      << "the description of the one that calls does not have it";
}

TEST_F(ComponentRemoteTest, IsToldThatNobodyIsThere) {
  Start();
  EXPECT_THAT(Answer(rig.module, "ask", "{times: 3}"), HasSubstr("genom::mwerr {what: \"not_connected"));
  EXPECT_THAT(Answer(*mill_, "add", "{name: map}"), HasSubstr("genom::mwerr {what: \"not_connected"));
}

TEST_F(ComponentRemoteTest, ComesBackFromOneThatDoesNotAnswer) {
  ASSERT_TRUE(Port::Connect(PortOf(*mill_, "beep"), PortAt("beep")));
  Port& beep = PortOf(*mill_, "beep");
  rig.RunCycles(2);  // and those of the other never
  const auto call = Begin("ask", "{times: 3}");
  WaitUntil(
      "it has called",
      [&] {
        rig.RunCycle();
        return beep.FindAnnotation<Callable>()->state().waiting == 1;
      },
      kLongEnough);
  ASSERT_TRUE(rig.runtime.Delete(rig.module));
  EXPECT_NE(call->Poll(clock_.Now()), CallStatus::kPending) << "the component has come to its end";
}

TEST_F(ComponentRemoteTest, SaysThatNoneCanTakeItsPlaceWhileOneDoesNotAnswer) {
  ASSERT_TRUE(Port::Connect(PortOf(*mill_, "beep"), PortAt("beep")));
  Port& beep = PortOf(*mill_, "beep");
  rig.RunCycles(2);
  const auto call = Begin("ask", "{times: 3}");
  const auto has_called = [&] {
    rig.RunCycle();
    return beep.FindAnnotation<Callable>()->state().waiting == 1;
  };
  WaitUntil("it has called", has_called, kLongEnough);
  std::string said;
  try {
    rig.module.FindAnnotation<BeforeHandOver>()->settle();
  } catch (const std::exception& error) {
    said = error.what();
  }
  EXPECT_EQ(said, "one of its asynchronous codels does not come back");
}

}  // namespace
}  // namespace runnel::test
