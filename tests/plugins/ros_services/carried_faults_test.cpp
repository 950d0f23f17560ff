// Calls that are carried over a network end once, each with its own outcome, wherever memory runs out.

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <new>
#include <regex>
#include <string>

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
    Take(*near);
    offered = std::make_unique<OfferedService>(runtime, ServiceOfferOptions{.port = "/a/double", .service = "/double"},
                                               MessageLibrary::Standard(), ServiceDialect::kInFront, 2, wake);
    (void)offered->Follow(*there, [](std::uint64_t) { return true; });
    WaitUntilQuiet(*engine);
    for (int i = 0; i < 4; ++i) calls[static_cast<std::size_t>(i)] = client.Begin(i + 1);
  }
  void Take(WireParticipant& participant) {
    taken = std::make_unique<TakenService>(runtime, "/a/far", ServiceTakeOptions{.service = "/double"}, far,
                                           ServiceDialect::kInFront, 1, wake);
    (void)taken->Follow(participant);
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
  std::unique_ptr<ServiceEndpoints> other;
  std::array<CallFuture<int(int)>, 4> calls;
};

// One turn of the network's thread, which tells what it catches and goes on.
void TakeTurn(const auto& end) {
  try {
    if (end != nullptr) (void)end->Work();
  } catch (const std::bad_alloc&) {
  }
}

/// "…, 3 answered, 1 failed".
int Counted(const OfferedService& offered) {
  const std::string text = offered.Text();
  std::smatch found;
  EXPECT_TRUE(std::regex_search(text, found, std::regex("([0-9]+) answered, ([0-9]+) failed"))) << text;
  return std::stoi(found[1]) + std::stoi(found[2]);
}

/// `fails` meets the failing allocation, or several; then both ends go on, until each call has ended. `all_come`: to the
/// service.
void Endure(const std::function<void(Ends&)>& before, const std::function<void(Ends&)>& fails, bool all_come = false,
            std::size_t further = 0) {
  auto ends = std::make_unique<Ends>();
  before(*ends);
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { fails(*ends); },
      [&](bool) {
        const auto take_turns = [&] {
          TakeTurn(ends->taken);
          TakeTurn(ends->offered);
          ends->service.Serve();
        };
        for (auto& call : ends->calls) {
          WaitUntil("the call has ended", [&] {
            take_turns();
            return call.is_done();
          });
        }
        WaitUntil("nothing is under way any more", [&] { return ends->taken == nullptr || !ends->taken->Work(); });
        take_turns();
        const ServiceEndpoint& endpoint = ends->far->endpoint;
        ASSERT_EQ(endpoint.answered + endpoint.failed, ends->calls.size()) << "each is given back once";
        if (all_come) {
          ASSERT_EQ(Counted(*ends->offered), 4);
        }
        for (int i = 0; i < 4; ++i) {
          const auto outcome = ends->calls[static_cast<std::size_t>(i)].outcome();
          if (outcome) {
            ASSERT_EQ(*outcome, 2 * (i + 1));
          }
        }
        ends = std::make_unique<Ends>();
        before(*ends);
      },
      further);
  EXPECT_GT(points, 0u);
}

void AreSent(Ends& ends) {
  TakeTurn(ends.taken);
  WaitUntilQuiet(*ends.engine);
}

void AreServed(Ends& ends) {
  AreSent(ends);
  TakeTurn(ends.offered);
  ends.service.Serve();
}

// By a node whose answers are no answers of this service.
void AreAnsweredWrongly(Ends& ends) {
  const ServiceTopics topics = ends.offered->endpoints()->topics();
  ends.offered.reset();
  ends.other = std::move(*ServiceEndpoints::Start(ServiceEndpoints::Side::kServer, topics, *ends.there, 3, [] {}));
  WaitUntilQuiet(*ends.engine);
  AreSent(ends);
  while (const auto request = ends.other->Take()) (void)ends.other->Reply(request->id, Octets(8));
  WaitUntilQuiet(*ends.engine);
}

TEST(CarriedFaults, CallsAreSentOnceOrEnd) {
  Endure([](Ends&) {}, [](Ends& ends) { TakeTurn(ends.taken); });
}
TEST(CarriedFaults, RequestsAreAnsweredOrCounted) {
  Endure(
      AreSent, [](Ends& ends) { TakeTurn(ends.offered); }, true);
}
TEST(CarriedFaults, AnswersComeBackOrTheCallsEnd) {
  Endure(
      AreServed, [](Ends& ends) { TakeTurn(ends.offered); }, true);
}
TEST(CarriedFaults, CallsWhoseAnswersCannotBeReadEndOnce) {
  Endure(AreAnsweredWrongly, [](Ends& ends) { TakeTurn(ends.taken); });
}

/// A network in which nobody is.
struct Empty final : WireParticipant {
  struct Writer final : WireWriter {
    [[nodiscard]] const WireId& id() const noexcept override { return own; }
    [[nodiscard]] bool HasReader(std::uint64_t) const override { return false; }
    Result<void> Write(const std::shared_ptr<const Octets>&, std::int64_t) override { return {}; }
    WireId own{1};
  };
  struct Reader final : WireReader {
    [[nodiscard]] const WireId& id() const noexcept override { return own; }
    WireId own{2};
  };
  [[nodiscard]] const WireId& id() const noexcept override { return own; }
  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions&, OnMatched) override {
    return std::unique_ptr<WireWriter>(std::make_unique<Writer>());
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions&, OnSample, OnMatched) override {
    return std::unique_ptr<WireReader>(std::make_unique<Reader>());
  }
  WireId own{3};
};

TEST(CarriedFaults, CallsEndWithTheNetwork) {
  Empty empty;
  const auto wait_for_somebody = [&](Ends& ends) {
    ends.taken.reset();
    ends.Take(empty);
    TakeTurn(ends.taken);
  };
  Endure(
      wait_for_somebody, [](Ends& ends) { ends.taken.reset(); }, false, 20);
}

}  // namespace
}  // namespace runnel::test
