// Wherever memory runs out or a handler throws, each call ends once, with a reply or with what went wrong, and the service can
// be asked again.

#include <new>
#include <optional>

#include "plugins/testing/fault_injection.h"
#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

using Echoed = std::string(std::string);
const std::string kLongText(100, 'x');  // not within the text itself

class Echo final : public Module {
 public:
  using Module::Module;
  Service<Echoed> echo{this, "echo", &Echo::Say};

 private:
  Result<std::string> Say(const std::string& text) {
    InjectionPoint();
    if (text.empty()) return Error{.message = kLongText, .hint = kLongText};
    return text + text;
  }
  void Update() override { InjectionPoint(); }
};

/// Asks once, and then no more before it is told to.
class Caller final : public Module {
 public:
  using Module::Module;
  Client<Echoed> echo{this, "echo", {.calls = 4, .timeout = 50ms}};
  std::optional<std::string> question = kLongText;
  int begun = 0;
  int ended = 0;
  CallStatus status = CallStatus::kPending;
  std::size_t reply = 0;

 private:
  void Update() override {
    if (!question) return;
    const std::string asked = std::exchange(question, {}).value();
    const CallStatus now = echo.Call([this](const CallOutcome<std::string>& outcome) { Note(outcome); }, asked);
    if (now == CallStatus::kPending) ++begun;
  }
  void Note(const CallOutcome<std::string>& outcome) {
    ++ended;
    InjectionPoint();
    status = outcome.status();
    reply = outcome ? outcome->size() : 0;
  }
};

class ServingFaults : public EditorTest {
 protected:
  ServingFaults() {
    Register<Echo>("test/echo");
    Register<Caller>("test/caller");
    (void)TypeOf<CallRecord<Echoed>>();
    Make();
  }
  void Make() {
    Must({CreateModule{"/app/echo", "test/echo"}, CreateModule{"/app/caller", "test/caller"},
          ConnectPorts{"/app/echo/echo", "/app/caller/echo"}});
    auto& records = At<Port>("/app/echo/output/echo_calls");
    watcher = std::make_unique<Input<CallRecord<Echoed>>>(At<Group>("/app"), "watcher");
    ASSERT_TRUE(Port::Connect(records, *watcher));
    MustReady();
  }
  void MakeAnew() {
    watcher.reset();
    Must({DeleteElement{"/app/echo"}, DeleteElement{"/app/caller"}});
    Make();
    (void)scheduler.TakeFaults();
  }
  Caller& caller() { return At<Caller>("/app/caller"); }

  std::unique_ptr<Input<CallRecord<Echoed>>> watcher;
};

TEST_F(ServingFaults, EachCallEndsOnceAndTheServiceIsThereAgain) {
  for (const std::string& question : {kLongText, std::string()}) {
    for (const InjectedFault fault : kInjectedFaults) {
      std::size_t tried = 0;
      bool has_struck = true;
      for (std::size_t nth = 1; has_struck; ++nth, ++tried) {
        SCOPED_TRACE(NameOf(fault) + " " + std::to_string(nth));
        caller().question = question;
        FaultInjection injection(fault, nth);
        try {
          (void)scheduler.RunUntil(runtime.clock().Now() + 20ms);
        } catch (const std::bad_alloc&) {
        }
        injection.End();
        has_struck = injection.has_struck();
        Steps(10);  // longer than a call may take
        const auto faults = scheduler.TakeFaults();
        ASSERT_EQ(caller().ended <= caller().begun, true);
        if (faults.empty()) {
          ASSERT_EQ(caller().begun, 1);
          ASSERT_EQ(caller().ended, 1);
          ASSERT_NE(caller().status, CallStatus::kPending);
        } else {
          ASSERT_TRUE(has_struck);
          ASSERT_FALSE(faults.front().message.empty());
        }
        if (!has_struck) {
          ASSERT_EQ(caller().status, question.empty() ? CallStatus::kFailed : CallStatus::kAnswered);
        }
        MakeAnew();
        Steps(5);
        ASSERT_EQ(caller().reply, 2 * kLongText.size());
        MakeAnew();
      }
      EXPECT_GT(tried, 1u);
    }
  }
}

/// Its own thread meets the fault.
class SlowEcho final : public Module {
 public:
  using Module::Module;
  Service<Echoed> echo{this, "echo", &SlowEcho::Say};
  static inline std::atomic<std::size_t> nth{0};  // 0: none

 private:
  Result<std::string> Say(Activity& activity, const std::string& text) {
    thread_local std::optional<FaultInjection> injection;
    injection.reset();
    if (nth > 0) injection.emplace(InjectedFault::kAllocation, nth);
    activity.Report(0.5, "echoing");
    if (text.empty()) return Error{.message = kLongText, .hint = kLongText};
    return text + text;
  }
  void Update() override {}
};

TEST_F(ServingFaults, AnActivityEndsEachCallAndServesTheNext) {
  Register<SlowEcho>("test/slow_echo");
  Must({CreateModule{"/app/slow", "test/slow_echo"}});
  Client<Echoed> client{At<Group>("/app"), "client", {.timeout = 1h}};
  ASSERT_TRUE(Port::Connect(At<Port>("/app/slow/output/echo"), client.port()));
  Input<CallRecord<Echoed>> records{At<Group>("/app"), "records"};
  ASSERT_TRUE(Port::Connect(At<Port>("/app/slow/output/echo_calls"), records));
  MustReady();
  const auto ask = [&](const std::string& question, std::size_t nth) {
    SlowEcho::nth = nth;
    auto call = client.Begin(question);
    WaitUntil("it ends", [&] {
      Steps(1);
      return call.is_done();
    });
    const auto outcome = call.outcome();
    EXPECT_FALSE(!outcome && outcome.error().empty());
    return outcome.status();
  };
  for (std::size_t nth = 1; nth < 40; ++nth) {
    SCOPED_TRACE(nth);
    for (const std::string& question : {kLongText, std::string()}) {
      const CallStatus status = ask(question, nth);
      ASSERT_TRUE(status == CallStatus::kAnswered || status == CallStatus::kFailed);
      ASSERT_EQ(ask(kLongText, 0), CallStatus::kAnswered);
    }
  }
  EXPECT_EQ(ask(kLongText, 40), CallStatus::kAnswered) << "all points have had their turn";
  EXPECT_THAT(scheduler.TakeFaults(), IsEmpty());
}

// From a terminal, the page, another process.
TEST_F(ServingFaults, ACallFromOutsideBeginsOrNot) {
  std::unique_ptr<AnyCall> call;
  bool has_begun = false;
  const auto begin = [&] {
    call.reset();
    has_begun = false;
    try {
      const auto found = FindCallable(runtime, "/app/echo/echo");
      if (!found) return;
      call = (*found)->NewCall();
      if (!SetArguments(**found, "'" + kLongText + "'", *call)) return;
      has_begun = call->Begin(runtime.clock().Now(), 1h, {}) == CallStatus::kPending;
    } catch (const std::bad_alloc&) {
    }
  };
  const std::size_t points = AtEachPoint(InjectedFault::kAllocation, begin, [&](bool has_struck) {
    ASSERT_TRUE(has_struck || has_begun);
    if (!has_begun) begin();
    ASSERT_TRUE(has_begun);
    Steps(2);
    ASSERT_EQ(call->Poll(runtime.clock().Now()), CallStatus::kAnswered) << call->error();
    call.reset();
  });
  EXPECT_GT(points, 5u);
}

}  // namespace
}  // namespace runnel::test
