// What is offered to a network and taken from it is changed or not, wherever memory runs out, and can be changed the next time.
// Without an engine: those are libraries of others.

#include <functional>
#include <memory>
#include <new>
#include <set>

#include "plugins/network/xml_network_words.h"
#include "plugins/services/client.h"
#include "plugins/structure/change_history.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

/// An application with a network that nobody runs.
struct Offerer {
  Offerer() {
    network.AddOffer({.port = "/application/module/output/row", .topic = "/a_row_of_a_long_name"});
    AddNetworkChanges(runtime);
    (void)runtime.MakeReady(runtime.root());
  }
  /// What is offered and what is connected. Outputs of the network that nothing is connected to are no part of the
  /// application: they are there from when somebody has asked, and go with it.
  std::string Text() {
    const std::lock_guard lock(runtime.structure_mutex());
    std::string text;
    for (const OfferOptions& each : network.options().offers) text += "offer " + each.port + " " + each.topic + "\n";
    std::set<std::string> edges;
    runtime.root().Visit([&](FrameworkElement& each) {
      if (!each.IsAtOrBelow(network)) text += each.path() + "\n";
      if (const auto* const port = dynamic_cast<const Port*>(&each)) {
        for (const Connection& edge : port->outgoing()) edges.insert(each.path() + " > " + edge.to->path() + "\n");
        for (const Port* from : port->incoming()) edges.insert(each.path() + " < " + from->path() + "\n");
      }
    });
    for (const std::string& each : edges) text += each;
    return text;
  }

  Runtime runtime;
  ModuleRegistry modules;
  Group& group = runtime.Create<Group>(runtime.root(), "application");
  Module1& module = runtime.Create<Module1>(group, "module");
  NetworkElement& network = runtime.Create<NetworkElement>(group, "network", NetworkOptions{});
  StructureEditor editor{runtime, modules, nullptr};
  ChangeHistory history{editor};
};

using Action = std::function<bool(Offerer&)>;

void Endure(const Action& before, const Action& action, bool is_forgotten = false) {
  const auto attempt = [&](Offerer& world) {
    try {
      return action(world);
    } catch (const std::bad_alloc&) {
      return false;
    }
  };
  std::string done;
  {
    Offerer world;
    ASSERT_TRUE(before(world));
    ASSERT_TRUE(action(world));
    done = world.Text();
  }
  // Each point at first, then fewer and fewer: descriptions of messages are read at each.
  std::size_t points = 0;
  bool has_struck = true;
  for (std::size_t nth = 1; has_struck; nth += 1 + nth / 20, ++points) {
    SCOPED_TRACE(nth);
    Offerer world;
    ASSERT_TRUE(before(world));
    const std::string text = world.Text();
    FaultInjection injection(InjectedFault::kAllocation, nth);
    const bool is_done = attempt(world);
    injection.End();
    has_struck = injection.has_struck();
    ASSERT_TRUE(is_done || has_struck);
    if (!is_done) {
      ASSERT_EQ(world.Text(), text);
      // An undo that has failed is forgotten by the history, which says so.
      if (is_forgotten) continue;
      ASSERT_TRUE(action(world)) << "at the second try";
    }
    ASSERT_EQ(world.Text(), done);
  }
  EXPECT_GT(points, 10u);
}

bool Nothing(Offerer& /*world*/) { return true; }
Action Applies(ExtensionChange change) {
  return [change = std::move(change)](Offerer& world) {
    const ChangeOutcome outcome = world.history.Apply({change});
    EXPECT_TRUE(outcome || !outcome.diagnostics.ToString().empty());
    return outcome.is_done;
  };
}
bool IsUndone(Offerer& world) { return world.history.Undo().is_done; }

const ExtensionChange kOffer{"offer", {"/application/module/place"}, {{"topic", "/a_place_of_a_long_name"}}};
const ExtensionChange kWithdraw{
    "offer", {"/application/module/row"}, {{"topic", "/a_row_of_a_long_name"}, {"remove", "true"}}};
const ExtensionChange kTake{"take", {"/somebody/elsewhere/far_away", "/application/module/goal"}};
const ExtensionChange kGiveUp{
    "take", {"/somebody/elsewhere/far_away", "/application/module/goal"}, {{"remove", "true"}}};

TEST(OfferFaults, APortIsOfferedOrNot) { Endure(Nothing, Applies(kOffer)); }
TEST(OfferFaults, AnOfferIsWithdrawnOrNot) { Endure(Nothing, Applies(kWithdraw)); }
TEST(OfferFaults, AnOfferIsTakenBackOrNot) { Endure(Applies(kOffer), IsUndone, true); }
TEST(OfferFaults, ATopicIsTakenOrNot) { Endure(Nothing, Applies(kTake)); }
TEST(OfferFaults, ATopicIsTakenNoMoreOrStill) { Endure(Applies(kTake), Applies(kGiveUp)); }

TEST(OfferFaults, AServiceElsewhereIsTakenOrNot) {
  struct Asker : Offerer {
    Client<int(int)> client{group, "client"};
  };
  std::size_t points = 0;
  bool has_struck = true;
  for (std::size_t nth = 1; has_struck; nth += 1 + nth / 20, ++points) {
    SCOPED_TRACE(nth);
    Asker world;
    const auto take = [&]() -> Port* {
      try {
        const std::lock_guard lock(world.runtime.structure_mutex());
        const auto taken = world.network.AddServiceTake({.service = "/somebody/elsewhere/double"}, world.client.port());
        return taken ? *taken : nullptr;
      } catch (const std::bad_alloc&) {
        return nullptr;
      }
    };
    FaultInjection injection(InjectedFault::kAllocation, nth);
    const Port* output = take();
    injection.End();
    has_struck = injection.has_struck();
    ASSERT_TRUE(output != nullptr || has_struck);
    if (output == nullptr) {
      ASSERT_TRUE(world.network.service_takes().empty());
      output = take();
    }
    ASSERT_NE(output, nullptr) << "at the second try";
    ASSERT_EQ(world.network.service_takes().size(), 1u);
    ASSERT_EQ(world.network.service_takes()[0].path, output->path());
  }
  EXPECT_GT(points, 10u);
}

}  // namespace
}  // namespace runnel::test
