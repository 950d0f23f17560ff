// Two machines, as far as programs see, between which some of what is sent gets lost.

#include <array>
#include <chrono>
#include <cstring>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include "plugins/wire_cyclone/cyclone_wire.h"
#ifdef RUNNEL_HAS_FAST
#include "plugins/wire_fast/fast_wire.h"
#endif
#include "tests/plugins/wire/wire_ends.h"
#include "tests/support/child_process.h"
#include "tests/support/lossy_cable.h"
#include "tests/support/own_network.h"

namespace runnel::test {
namespace {

using MakeLossyEngine = std::shared_ptr<WireEngine> (*)();

constexpr std::uint8_t kPictures = 60;
constexpr std::size_t kPictureSize = 200'000;

// More is said of them than fits into a frame, too.
WireEndpointOptions Pictures() {
  return {.topic = "rt/pictures", .type = "Picture", .qos = {.depth = 128}, .user_data = std::string(3000, 'x')};
}

std::unique_ptr<WireParticipant> JoinNetwork(WireEngine& engine, Members& members) {
  auto joined = engine.Join({.domain = 0, .reach = WireReach::kNetwork}, members);
  return joined ? std::move(*joined) : nullptr;
}

// In a network of its own; says 'n' when it is there, begins when it is told to, and says 'm' for the first of the pictures, 'l'
// when the last has come, and 'x' for each that has not come in its order, or is not as it was.
void TakePictures(MakeLossyEngine make, int from, int to) {
  char octet = 0;
  if (!EnterOwnNetwork() || write(to, "n", 1) != 1 || read(from, &octet, 1) != 1) return;
  Members members;
  const auto engine = make();
  const auto joined = JoinNetwork(*engine, members);
  if (joined == nullptr) return;
  std::uint8_t last = 0;
  bool is_first = true;
  const auto reader = joined->MakeReader(Pictures(),
                                         [&](const WireSample& sample) {
                                           const auto number = std::to_integer<std::uint8_t>(sample.octets[4]);
                                           bool is_right = sample.octets.size() >= kPictureSize &&
                                                           (number == 0 ? last == 0 : number == last + 1);
                                           for (std::size_t i = 5; i < kPictureSize; ++i)
                                             is_right = is_right && sample.octets[i] == sample.octets[4];
                                           last = number;
                                           if (!is_right) (void)!write(to, "x", 1);
                                           if (is_first) (void)!write(to, "m", 1);
                                           is_first = false;
                                           if (number == kPictures) (void)!write(to, "l", 1);
                                         },
                                         {});
  if (reader) pause();
}

// Begins when it is told to, with the first again and again, and then, when it is told so, has the others follow.
void SendPictures(MakeLossyEngine make, int from) {
  char octet = 0;
  if (read(from, &octet, 1) != 1) return;
  Members members;
  const auto engine = make();
  const auto joined = JoinNetwork(*engine, members);
  if (joined == nullptr) return;
  const auto writer = joined->MakeWriter(Pictures(), {});
  const auto send = [&](std::uint8_t number) {
    auto octets = std::make_shared<Octets>(kPictureSize, std::byte{number});
    (*octets)[0] = (*octets)[2] = (*octets)[3] = std::byte{0};
    (*octets)[1] = std::byte{1};
    return (*writer)->Write(octets, 1).has_value();
  };
  for (pollfd told{from, POLLIN, 0}; poll(&told, 1, 100) == 0;) {
    if (!send(0)) return;
  }
  for (std::uint8_t i = 1; i <= kPictures; ++i) {
    if (!send(i)) return;
    usleep(20'000);
  }
  pause();
}

class LossyNetworkTest : public testing::TestWithParam<MakeLossyEngine> {};

TEST_P(LossyNetworkTest, EachOfReliablePicturesComes) {
  if (OwnDomain() != 0) GTEST_SKIP() << "needs the right to make networks";
  const MakeLossyEngine make = GetParam();
  const Child reader([make](int from, int to) { TakePictures(make, from, to); });
  const Child writer([make](int from, int) { SendPictures(make, from); });
  ASSERT_EQ(reader.Said(), 'n');
  const LossyCable cable(reader.process(), {.loss = 0.05, .delay = std::chrono::milliseconds(0), .seed = 3});
  if (!cable.is_there()) GTEST_SKIP() << "needs iproute2, and /dev/net/tun";
  for (const Child* const each : {&reader, &writer}) ASSERT_EQ(write(each->to(), "b", 1), 1);
  ASSERT_EQ(reader.Said(), 'm');
  ASSERT_EQ(write(writer.to(), "b", 1), 1);
  EXPECT_EQ(reader.Said(), 'l');
}

INSTANTIATE_TEST_SUITE_P(Cyclone, LossyNetworkTest, testing::Values(&MakeCycloneWire));
#ifdef RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, LossyNetworkTest, testing::Values(&MakeFastWire));
#endif

}  // namespace
}  // namespace runnel::test
