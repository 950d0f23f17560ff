// A process that reads and stands still: nobody waits for it, and what it has then is what is new.

#include <array>
#include <atomic>
#include <cstring>
#include <memory>

#include <gtest/gtest.h>
#include <poll.h>
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

constexpr std::uint32_t kLast = 8000;  // of the values,
constexpr std::size_t kSize = 1000;    // which are more than sockets have room for
const WireEndpointOptions kNumbers = {.topic = "rt/numbers", .type = "Numbers"};

std::shared_ptr<Octets> Numbered(std::uint32_t number) {
  auto octets = std::make_shared<Octets>(kSize);
  (*octets)[1] = std::byte{1};
  std::memcpy(octets->data() + 4, &number, sizeof number);
  return octets;
}

bool Say(int to, char what) { return write(to, &what, 1) == 1; }

// Says 'm' when it reads what is written, 'l' when it has the last value, and 'x' if one comes after a newer one.
void ReadNumbers(MakeEngine make, unsigned domain, int to) {
  Members members;
  std::uint32_t newest = 0;
  bool is_matched = false;
  const auto engine = make();
  const auto joined = engine->Join({.domain = domain}, members);
  if (!joined) return;
  const auto reader = (*joined)->MakeReader(kNumbers,
                                            [&](const WireSample& sample) {
                                              std::uint32_t number = 0;
                                              std::memcpy(&number, sample.octets.data() + 4, sizeof number);
                                              if (number < newest) (void)Say(to, 'x');
                                              newest = number;
                                              if (!is_matched || number == kLast)
                                                (void)Say(to, number == kLast ? 'l' : 'm');
                                              is_matched = true;
                                            },
                                            {});
  if (reader) pause();
}

// The first again and again, until it is told to write the others; says 'd' when it has.
void WriteNumbers(MakeEngine make, unsigned domain, int from, int to) {
  Members members;
  const auto engine = make();
  const auto joined = engine->Join({.domain = domain}, members);
  if (!joined) return;
  const auto writer = (*joined)->MakeWriter(kNumbers, {});
  if (!writer) return;
  for (pollfd told{from, POLLIN, 0}; poll(&told, 1, 5) == 0;) {
    if (!(*writer)->Write(Numbered(0), 1)) return;
  }
  for (std::uint32_t i = 1; i <= kLast; ++i) {
    if (!(*writer)->Write(Numbered(i), 1)) return;
  }
  if (Say(to, 'd')) pause();
}

class StoppedReaderTest : public testing::TestWithParam<MakeEngine> {};

TEST_P(StoppedReaderTest, HoldsNobodyUpAndHasTheNewestWhenItGoesOn) {
  const unsigned domain = OwnDomain();
  const MakeEngine make = GetParam();
  const Child stopped([&](int, int to) { ReadNumbers(make, domain, to); });
  const Child other([&](int, int to) { ReadNumbers(make, domain, to); });
  const Child writer([&](int from, int to) { WriteNumbers(make, domain, from, to); });
  ASSERT_EQ(stopped.Said(), 'm');
  ASSERT_EQ(other.Said(), 'm');
  stopped.Stop();
  ASSERT_TRUE(Say(writer.to(), 'w'));
  EXPECT_EQ(writer.Said(), 'd');
  EXPECT_EQ(other.Said(), 'l');
  stopped.GoOn();
  EXPECT_EQ(stopped.Said(), 'l');
}

INSTANTIATE_TEST_SUITE_P(Cyclone, StoppedReaderTest, testing::Values(&MakeCycloneWire));
#ifdef RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, StoppedReaderTest, testing::Values(&MakeFastWire));
#endif

}  // namespace
}  // namespace runnel::test
