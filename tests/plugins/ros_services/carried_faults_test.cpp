// Calls that are carried over a network end once, each with its own outcome, wherever memory runs out.

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <new>

#include "core/element/runtime.h"
#include "core/lockfree/wake_event.h"
#include "core/module/group.h"
#include "core/port/typed_ports.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_services/offered_service.h"
#include "plugins/ros_services/taken_service.h"
#include "plugins/services/client.h"
#include "plugins/services/service.h"
#include "plugins/testing/fault_injection.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

struct Nobody final : WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}
};

struct Doubler {
  Result<int> Double(const int& number) {
    if (number == 2) return Error{.message = std::string(200, 'x')};  // more than fits without memory
    return 2 * number;
  }
};

/// Both ends of a network of this process.
struct Ends {
  Ends() {
    (void)runtime.MakeReady(runtime.root());
    const auto& link = *client.port().FindAnnotation<ClientForm>();
    auto form = ServiceForm::Make(link.form->arguments(), link.form->reply(), "", MessageLibrary::Standard());
    far = std::make_shared<DistantService>(link.form, *form);
    output = FindTypedPorts(client.port().type())->MakeOutput(group, "far");
    DistantService::PublishBy(*output, far);
    (void)Port::Connect(*output, client.port());
    taken = std::make_unique<TakenService>(runtime, "/a/far", ServiceTakeOptions{.service = "/double"}, far,
                                           ServiceDialect::kInFront, 1, wake);
    (void)taken->Follow(*near);
    offered = std::make_unique<OfferedService>(runtime, ServiceOfferOptions{.port = "/a/double", .service = "/double"},
                                               MessageLibrary::Standard(), ServiceDialect::kInFront, 2, wake);
    (void)offered->Follow(*there, [](std::uint64_t) { return true; });
    WaitUntilQuiet(*engine);
    for (int i = 0; i < 4; ++i) calls[static_cast<std::size_t>(i)] = client.Begin(i + 1);
  }

  Runtime runtime;
  Group& group = runtime.Create<Group>(runtime.root(), "a");
  Doubler doubler;
  Service<int(int)> service{group, doubler, "double", &Doubler::Double};
  Client<int(int)> client{group, "client", {.timeout = std::chrono::milliseconds(200)}};  // what got lost ends soon
  Nobody nobody;
  const std::shared_ptr<WakeEvent> wake = std::make_shared<WakeEvent>();
  const std::shared_ptr<WireEngine> engine = MakeFakeWire();
  std::unique_ptr<WireParticipant> near = std::move(*engine->Join({.name = "near"}, nobody));
  std::unique_ptr<WireParticipant> there = std::move(*engine->Join({.name = "there"}, nobody));
  std::unique_ptr<Port> output;
  std::shared_ptr<DistantService> far;
  std::unique_ptr<TakenService> taken;
  std::unique_ptr<OfferedService> offered;
  std::array<CallFuture<int(int)>, 4> calls;
};

// One turn of the network's thread, which tells what it catches and goes on.
void TakeTurn(const auto& end) {
  try {
    (void)end->Work();
  } catch (const std::bad_alloc&) {
  }
}

/// `fails` meets the failing allocation; then both ends go on, until each call has ended.
void Endure(const std::function<void(Ends&)>& before, const std::function<void(Ends&)>& fails) {
  auto ends = std::make_unique<Ends>();
  before(*ends);
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { fails(*ends); },
      [&](bool) {
        for (auto& call : ends->calls) {
          WaitUntil("the call has ended", [&] {
            TakeTurn(ends->taken);
            TakeTurn(ends->offered);
            ends->service.Serve();
            return call.is_done();
          });
        }
        for (int i = 0; i < 4; ++i) {
          const auto outcome = ends->calls[static_cast<std::size_t>(i)].outcome();
          if (outcome) {
            ASSERT_EQ(*outcome, 2 * (i + 1));
          }
        }
        ends = std::make_unique<Ends>();
        before(*ends);
      });
  EXPECT_GT(points, 5u);
}

void AreServed(Ends& ends) {
  TakeTurn(ends.taken);
  WaitUntilQuiet(*ends.engine);
  TakeTurn(ends.offered);
  ends.service.Serve();
}

TEST(CarriedFaults, CallsAreSentOnceOrEnd) {
  Endure([](Ends&) {}, [](Ends& ends) { TakeTurn(ends.taken); });
}
TEST(CarriedFaults, AnswersComeBackOrTheCallsEnd) {
  Endure(AreServed, [](Ends& ends) { TakeTurn(ends.offered); });
}

}  // namespace
}  // namespace runnel::test
