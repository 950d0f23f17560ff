// A part that could not be made leaves nothing behind in the cycle of its module, wherever memory runs out.

#include <functional>
#include <new>
#include <optional>

#include "plugins/services/services_at_run_time.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

const SignatureTypes kWords{&TypeOf<std::string>(), {&TypeOf<std::string>()}};

/// Has parts that are made when somebody wants them.
class Host final : public Module {
 public:
  using Module::Module;

  template <typename Part, typename... Arguments>
  bool Make(std::optional<Part>& part, Arguments&&... arguments) {
    part.emplace(std::forward<Arguments>(arguments)...);
    return part.has_value();
  }
  bool MakeService() {
    return Make(service, this, "double", &Host::Double, ServiceOptions{.description = "doubles what it is given"});
  }
  bool MakeActivity() { return Make(service, this, "double", &Host::DoubleSlowly); }
  bool MakeClient() { return Make(client, this, "ask"); }
  bool MakeLateService(bool is_activity = false) {
    const auto serve = [](const CallForm&, CallBase&, Activity*) { return Result<void>(); };
    return Make(late_service, OutputGroup(), "late", kWords, ServiceOptions{.arguments = {"text"}},
                CallableOptions{.is_activity = is_activity, .defaults = "{text: a}"}, serve);
  }
  bool MakeLateClient() {
    return Make(late_client, InputGroup(), "ask_late", kWords, ClientOptions{}, [](CallBase&, CallStatus) {});
  }

  std::optional<Service<int(int)>> service;
  std::optional<Client<int(int)>> client;
  std::optional<ServiceAtRunTime> late_service;
  std::optional<ClientAtRunTime> late_client;
  int cycles = 0;

 private:
  Result<int> Double(int value) { return 2 * value; }
  Result<int> DoubleSlowly(Activity&, int value) { return 2 * value; }
  void Update() override { ++cycles; }
};

struct PartWorld {
  PartWorld() {
    CreateThread(runtime, "fast", {.period = 10ms});
    (void)runtime.MakeReady(runtime.root());
  }
  void Run() { EXPECT_TRUE(scheduler.RunUntil(runtime.clock().Now() + 20ms)); }
  /// A call from beside the module is answered.
  void ExpectServed() {
    Client<int(int)> asker{runtime.root(), "asker", {.timeout = 1h}};
    ASSERT_TRUE(Port::Connect(host.service->port(), asker.port()));
    auto call = asker.Begin(2);
    WaitUntil("it is answered", [&] {
      Run();
      return call.is_done();
    });
    ASSERT_TRUE(call.outcome()) << call.outcome().error();
    EXPECT_EQ(*call.outcome(), 4);
  }
  /// The module is called back.
  void ExpectCalledBack() {
    Service<int(int)> answerer{runtime.root(), *this, "answerer", &PartWorld::Double};
    ASSERT_TRUE(Port::Connect(answerer.port(), host.client->port()));
    ASSERT_EQ(host.client->Call([this](const auto& outcome) { called_back = *outcome; }, 2), CallStatus::kPending);
    answerer.Serve();
    Run();
    EXPECT_EQ(called_back, 4);
  }
  Result<int> Double(int value) { return 2 * value; }

  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  Host& host = runtime.Create<Host>(runtime.root(), "host");
  int called_back = 0;
};

/// `make` fails at each point, and is tried again before the module runs for the first time: the part works then.
void EndureAtOnce(const std::function<bool(Host&)>& make, void (PartWorld::*expect_it_works)()) {
  auto world = std::make_unique<PartWorld>();
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          (void)make(world->host);
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool has_struck) {
        if (has_struck) (void)make(world->host);
        ASSERT_TRUE(world->runtime.MakeReady(world->runtime.root()));
        (*world.*expect_it_works)();
        world = std::make_unique<PartWorld>();
      });
  EXPECT_GT(points, 5u);
}

/// `make` fails at each point; the module goes on, has the part at the second try, and is deleted.
void Endure(const std::function<bool(Host&)>& make) {
  using World = PartWorld;
  {
    World world;  // what the process does once
    ASSERT_TRUE(make(world.host));
  }
  auto world = std::make_unique<World>();
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          (void)make(world->host);
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool has_struck) {
        world->Run();
        ASSERT_GT(world->host.cycles, 0);
        ASSERT_THAT(world->scheduler.TakeFaults(), IsEmpty());
        if (has_struck) {
          const ChangeScope changes(world->runtime);
          (void)make(world->host);
        }
        const int before = world->host.cycles;
        world->Run();
        ASSERT_GT(world->host.cycles, before);
        world = std::make_unique<World>();
      });
  EXPECT_GT(points, 5u);
}

TEST(PartFaults, AServiceIsThereOrNot) {
  Endure([](Host& host) { return host.MakeService(); });
  EndureAtOnce([](Host& host) { return host.MakeService(); }, &PartWorld::ExpectServed);
}
TEST(PartFaults, AnActivityIsThereOrNot) {
  Endure([](Host& host) { return host.MakeActivity(); });
  EndureAtOnce([](Host& host) { return host.MakeActivity(); }, &PartWorld::ExpectServed);
}
TEST(PartFaults, AClientIsThereOrNot) {
  Endure([](Host& host) { return host.MakeClient(); });
  EndureAtOnce([](Host& host) { return host.MakeClient(); }, &PartWorld::ExpectCalledBack);
}
TEST(PartFaults, AServiceOfTypesKnownAtRunTimeIsThereOrNot) {
  Endure([](Host& host) { return host.MakeLateService(); });
}
TEST(PartFaults, AnActivityOfTypesKnownAtRunTimeIsThereOrNot) {
  Endure([](Host& host) { return host.MakeLateService(true); });
}
TEST(PartFaults, AClientOfTypesKnownAtRunTimeIsThereOrNot) {
  Endure([](Host& host) { return host.MakeLateClient(); });
}

// What goes has nobody to tell.
TEST(PartFaults, APartGoesWithoutMemory) {
  for (const bool is_under_way : {false, true}) {
    bool has_struck = true;
    for (std::size_t nth = 1; has_struck; ++nth) {
      SCOPED_TRACE(nth);
      PartWorld world;
      ASSERT_TRUE(world.host.MakeService() && world.host.MakeClient());
      ASSERT_TRUE(Port::Connect(world.host.service->port(), world.host.client->port()));
      if (is_under_way) world.host.client->Send(1);
      FaultInjection injection(InjectedFault::kAllocation, nth);
      world.host.client.reset();
      world.host.service.reset();
      injection.End();
      has_struck = injection.has_struck();
      world.Run();
      ASSERT_GT(world.host.cycles, 0);
    }
  }
}

}  // namespace
}  // namespace runnel::test
