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

/// `make` fails at each point; the module goes on, has the part at the second try, and is deleted.
void Endure(const std::function<bool(Host&)>& make) {
  struct World {
    World() {
      CreateThread(runtime, "fast", {.period = 10ms});
      (void)runtime.MakeReady(runtime.root());
    }
    void Run() { EXPECT_TRUE(scheduler.RunUntil(runtime.clock().Now() + 20ms)); }
    Runtime runtime;
    Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
    Host& host = runtime.Create<Host>(runtime.root(), "host");
  };
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
}
TEST(PartFaults, AnActivityIsThereOrNot) {
  Endure([](Host& host) { return host.MakeActivity(); });
}
TEST(PartFaults, AClientIsThereOrNot) {
  Endure([](Host& host) { return host.MakeClient(); });
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

}  // namespace
}  // namespace runnel::test
