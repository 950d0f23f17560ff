// Readers in several processes that announce one group, at which each of them hears values.

#include <memory>
#include <tuple>

#include <gtest/gtest.h>
#include <unistd.h>

#include "plugins/wire_cyclone/cyclone_wire.h"
#ifdef RUNNEL_HAS_FAST
#include "plugins/wire_fast/fast_wire.h"
#endif
#include "tests/plugins/wire/wire_ends.h"
#include "tests/support/child_process.h"
#include "tests/support/own_network.h"

namespace runnel::test {
namespace {

using MakeEngine = std::shared_ptr<WireEngine> (*)();

/// The engine of who writes, and how far all reach.
class SharedGroupTest : public testing::TestWithParam<std::tuple<MakeEngine, WireReach>> {};

// Latched, as a writer knows a reader before the reader knows it, and a reader leaves out what was written till then.
const WireEndpointOptions kShared = {.topic = "rt/shared", .type = "numbers::Four", .qos = {.is_latched = true}};

// Says 'v' for each value.
void ReadShared(const WireMemberOptions& options, int to) {
  Members members;
  const auto engine = MakeCycloneWire();
  const auto joined = engine->Join(options, members);
  if (!joined) return;
  const auto reader = (*joined)->MakeReader(kShared, [&](const WireSample&) { (void)write(to, "v", 1); }, {});
  if (reader) pause();
}

// Says 'm' when it has two readers, writes a value each time it is told to, and says 'w'.
void WriteShared(MakeEngine make, const WireMemberOptions& options, int from, int to) {
  Members members;
  const auto engine = make();
  const auto joined = engine->Join(options, members);
  if (!joined) return;
  const auto on_matched = [&](std::size_t count) {
    if (count == 2) (void)write(to, "m", 1);
  };
  const auto writer = (*joined)->MakeWriter(kShared, on_matched);
  if (!writer) return;
  for (char told = 0; read(from, &told, 1) == 1 && (*writer)->Write(Four(1), 1);) (void)write(to, "w", 1);
}

// Fast DDS 2.9 ends the process of the writer when it meets the second reader, if it may use the group.
TEST_P(SharedGroupTest, BothReadersHaveTheValueAndTheWriterStays) {
  const auto [make, reach] = GetParam();
  const WireMemberOptions options = {.domain = OwnDomain(), .reach = reach};
  const Child one([&](int, int to) { ReadShared(options, to); });
  const Child other([&](int, int to) { ReadShared(options, to); });
  const Child writer([&, make = make](int from, int to) { WriteShared(make, options, from, to); });
  ASSERT_EQ(writer.Said(), 'm');
  ASSERT_EQ(write(writer.to(), "w", 1), 1);
  ASSERT_EQ(writer.Said(), 'w');
  ASSERT_EQ(one.Said(), 'v');
  EXPECT_EQ(other.Said(), 'v');
}

constexpr auto kReaches = {WireReach::kLoopback, WireReach::kMachine};
const auto kNameOfReach = [](const testing::TestParamInfo<SharedGroupTest::ParamType>& tested) {
  return std::get<WireReach>(tested.param) == WireReach::kLoopback ? "Loopback" : "Machine";
};
INSTANTIATE_TEST_SUITE_P(Cyclone, SharedGroupTest,
                         testing::Combine(testing::Values(&MakeCycloneWire), testing::ValuesIn(kReaches)),
                         kNameOfReach);
#ifdef RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, SharedGroupTest,
                         testing::Combine(testing::Values(&MakeFastWire), testing::ValuesIn(kReaches)), kNameOfReach);
#endif

}  // namespace
}  // namespace runnel::test
