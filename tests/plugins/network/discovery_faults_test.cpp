// Who is in the network is noted as a whole or not at all, wherever memory runs out.

#include <new>
#include <string>

#include <gtest/gtest.h>

#include "plugins/network_discovery/discovery_table.h"
#include "plugins/testing/fault_injection.h"

namespace runnel::test {
namespace {

const std::string kLong(100, 'x');  // more than fits without memory

WireEndpoint Endpoint() {
  WireEndpoint endpoint{.handle = 7, .id = {1}, .participant = {2}, .is_writer = true};
  endpoint.options = {
      .topic = "rt/" + kLong, .type = "numbers::" + kLong, .user_data = kLong + "\x1b[2J", .unmet = kLong};
  return endpoint;
}

TEST(DiscoveryFaults, AnEndpointIsNotedAsAWholeOrNotAtAll) {
  DiscoveryTable table([] {});
  const WireEndpoint endpoint = Endpoint();
  bool is_told = false;
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { is_told = CallBack([&] { table.OnEndpoint(endpoint); }); },
      [&](bool has_struck) {
        EXPECT_NE(is_told, has_struck);
        const auto known = table.endpoints();
        ASSERT_EQ(known.size(), is_told ? 1U : 0U);
        if (!is_told) return;
        EXPECT_EQ(known[0].options.topic, endpoint.options.topic);
        EXPECT_EQ(known[0].options.unmet, endpoint.options.unmet);
        EXPECT_EQ(known[0].options.user_data.find('\x1b'), std::string::npos);
      });
  EXPECT_GT(points, 4U);
}

TEST(DiscoveryFaults, OneThatIsNotedAlreadyStaysAsItWas) {
  DiscoveryTable table([] {});
  table.OnEndpoint(Endpoint());
  WireEndpoint endpoint = Endpoint();
  endpoint.options.topic = "rt/other_" + kLong;
  bool is_told = false;
  AtEachPoint(
      InjectedFault::kAllocation, [&] { is_told = CallBack([&] { table.OnEndpoint(endpoint); }); },
      [&](bool) {
        const auto known = table.endpoints();
        ASSERT_EQ(known.size(), 1U);
        EXPECT_EQ(known[0].options.topic, is_told ? endpoint.options.topic : Endpoint().options.topic);
        EXPECT_EQ(known[0].options.user_data.find('\x1b'), std::string::npos);
      });
}

TEST(DiscoveryFaults, ItIsKnownThatSomebodyHasBeenMissed) {
  int changes = 0;
  DiscoveryTable table([&] { ++changes; });
  EXPECT_FALSE(table.has_missed());
  table.OnMissed();
  EXPECT_TRUE(table.has_missed());
  EXPECT_EQ(changes, 1);
}

}  // namespace
}  // namespace runnel::test
