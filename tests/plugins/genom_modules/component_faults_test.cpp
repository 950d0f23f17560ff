// Components of GenoM3, wherever memory runs out or a codel throws: one is made, replaced and deleted or not; each request of
// its services ends once, and the component that has failed can be replaced by one that serves again.

#include <chrono>
#include <memory>
#include <new>
#include <string>

#include "core/types/text_format.h"
#include "plugins/services/any_call.h"
#include "tests/support/faulty_operation.h"

extern "C" void InjectionPointForPlugins() { runnel::test::InjectionPoint(); }

namespace runnel::test {
namespace {

std::unique_ptr<Application> MakeWithComponents() {
  auto loaded = Application::LoadText(R"(<application name="robot">
  <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/> <thread name="fast" period="5ms"/>
  <load plugin="mill"/> <load plugin="probe"/>
  <module name="mill" type="mill/mill"/>
</application>)",
                                      {.plugin_folders = {RUNNEL_TEST_PLUGIN_FOLDER}});
  EXPECT_TRUE(loaded) << loaded.diagnostics().ToString();
  if (!loaded) return nullptr;
  EXPECT_TRUE(loaded->RunCycles(10));
  return loaded.Take();
}

std::unique_ptr<AnyCall> Ask(Application& application, const std::string& service, const std::string& arguments) {
  const auto found = FindCallable(application.runtime(), "/robot/mill/" + service);
  EXPECT_TRUE(found) << found.error().ToString();
  auto call = (*found)->NewCall();
  if (!arguments.empty()) {
    EXPECT_TRUE(SetArguments(**found, arguments, *call));
  }
  EXPECT_EQ(call->Begin(application.runtime().clock().Now(), std::chrono::hours(1), {}), CallStatus::kPending);
  return call;
}

CallStatus StatusOf(Application& application, AnyCall& call) { return call.Poll(application.runtime().clock().Now()); }

void ExpectItServes(Application& application) {
  const auto call = Ask(application, "beep", "{times: 3}");
  EXPECT_TRUE(application.RunCycles(10));
  EXPECT_EQ(StatusOf(application, *call), CallStatus::kAnswered) << call->error();
}

FaultyOperation Changes(ChangeSet changes, bool leaves_mill = true) {
  return {.make = MakeWithComponents,
          .carry_out = [changes](Application& application) { return application.Apply(changes).ToResult(); },
          .prove =
              [leaves_mill](Application& application) {
                EXPECT_TRUE(application.RunCycles(4));
                if (leaves_mill) ExpectItServes(application);
              },
          .faults = {InjectedFault::kAllocation, InjectedFault::kException}};
}

// With asynchronous codels, for which it has threads, and a task in a thread of the application.
TEST(ComponentFaults, AComponentIsMadeOrNot) {
  EXPECT_GT(Endure(Changes({CreateModule{"/robot/probe", "probe/probe", {{"thread_of_drive", "fast"}}}})), 100u);
}
TEST(ComponentFaults, AComponentIsReplacedOrNot) {
  EXPECT_GT(Endure(Changes({ReplaceModule{"/robot/mill", "mill/mill"}})), 100u);
}
TEST(ComponentFaults, AComponentIsDeletedOrNot) {
  EXPECT_GT(Endure(Changes({DeleteElement{"/robot/mill"}}, false)), 10u);
}

const std::string kLong(100, 'x');  // not within the text itself

void EndureRequest(const std::string& service, const std::string& arguments) {
  for (const InjectedFault fault : kInjectedFaults) {
    bool has_struck = true;
    for (std::size_t nth = 1; has_struck && !::testing::Test::HasFailure(); ++nth) {
      SCOPED_TRACE(service + ": " + NameOf(fault) + " " + std::to_string(nth));
      const auto application = MakeWithComponents();
      (void)application->TakeEvents();
      const auto call = Ask(*application, service, arguments);
      FaultInjection injection(fault, nth);
      try {
        (void)application->RunCycles(20);
      } catch (const std::bad_alloc&) {
      }
      injection.End();
      has_struck = injection.has_struck();
      EXPECT_TRUE(application->RunCycles(100));
      const CallStatus status = StatusOf(*application, *call);
      EXPECT_NE(status, CallStatus::kPending) << "it is lost";
      if (status != CallStatus::kAnswered) {
        EXPECT_TRUE(has_struck);
        EXPECT_FALSE(call->error().empty());
      }
      bool has_failed = false;
      for (const ApplicationEvent& each : application->TakeEvents()) has_failed |= each.fault.has_value();
      if (has_failed) {
        const auto outcome = application->Apply({ReplaceModule{"/robot/mill", "mill/mill"}});
        EXPECT_TRUE(outcome) << outcome.diagnostics.ToString();
        EXPECT_TRUE(application->RunCycles(10));
      }
      ExpectItServes(*application);
    }
  }
}

TEST(ComponentRequestFaults, AFunctionAnswersOnceOrSaysWhyNot) { EndureRequest("say", "{what: '" + kLong + "'}"); }
TEST(ComponentRequestFaults, AnAttributeIsSetOnceOrSaysWhyNot) { EndureRequest("set_gain", "{gain: 2.5}"); }
TEST(ComponentRequestFaults, AnActivityEndsOnceOrSaysWhyNot) { EndureRequest("turns", "{times: 4}"); }

}  // namespace
}  // namespace runnel::test
