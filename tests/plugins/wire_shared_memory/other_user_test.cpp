// Users of one machine: each has the values of the others, and none has their memory.

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "plugins/wire_cyclone/cyclone_wire.h"
#include "plugins/wire_shared_memory/segment_server.h"
#include "plugins/wire_shared_memory/shared_memory_wire.h"
#include "tests/plugins/wire_shared_memory/nobody.h"
#include "tests/support/child_process.h"
#include "tests/support/own_network.h"
#ifdef RUNNEL_HAS_FAST
#include "plugins/wire_fast/fast_wire.h"
#endif

namespace runnel::test {
namespace {

constexpr uid_t kOne = 60'001;
constexpr uid_t kAnother = 60'002;
const WireEndpointOptions kPictures = {.topic = "rt/pictures", .type = "Picture"};

bool Tell(int to, char what) { return write(to, &what, 1) == 1; }

// What a server of memory hands out, asked by somebody who does not look whose it is.
std::size_t FilesFrom(const SegmentPlace& place) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::string name = "runnel-segments-";
  for (const std::byte each : place.server) {
    name += "0123456789abcdef"[std::to_integer<unsigned>(each) >> 4];
    name += "0123456789abcdef"[std::to_integer<unsigned>(each) & 15];
  }
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  const FileDescriptor link(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (connect(link.number(), reinterpret_cast<const sockaddr*>(&address), size) != 0) return 0;
  (void)send(link.number(), place.segment.data(), place.segment.size(), MSG_NOSIGNAL);
  char octet = 0;
  iovec part{&octet, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(2 * sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  if (recvmsg(link.number(), &message, 0) <= 0) return 0;
  const cmsghdr* const head = CMSG_FIRSTHDR(&message);
  return head == nullptr ? 0 : (head->cmsg_len - CMSG_LEN(0)) / sizeof(int);
}

// Asks for the memory of the place that comes, and says how many files there were.
void AskForMemory(int from, int to) {
  SegmentPlace place;
  if (read(from, &place, sizeof place) != sizeof place) return;
  const auto fetched = FetchSegment(place);
  (void)Tell(to, fetched ? 'f' : 'n');
  (void)Tell(to, static_cast<char>('0' + FilesFrom(place)));
}

TEST(OtherUserTest, IsNotHandedAnyMemory) {
  if (geteuid() != 0) GTEST_SKIP() << "needs the right to be other users";
  Child same(AskForMemory);
  Child other(AskForMemory, kOne);
  const auto server = std::move(*SegmentServer::Start());
  const auto segment = std::move(*WrittenSegment::Make(1000));
  server->Offer(*segment);
  SegmentPlace place = *segment->Put(Octets(1000));
  place.server = server->id();
  for (const Child* const each : {&same, &other}) {
    ASSERT_EQ(write(each->to(), &place, sizeof place), static_cast<ssize_t>(sizeof place));
  }
  EXPECT_EQ(same.Said(), 'f');
  EXPECT_EQ(same.Said(), '2');
  EXPECT_EQ(other.Said(), 'n');
  EXPECT_EQ(other.Said(), '0');
}

using MakeEngine = std::shared_ptr<WireEngine> (*)();

// Begins when it is told to.
void WritePictures(MakeEngine make, unsigned domain, int from) {
  char octet = 0;
  if (read(from, &octet, 1) != 1) return;
  Nobody nobody;
  const auto engine = MakeSharedMemoryWire(make());
  const auto joined = engine->Join({.domain = domain, .lease = std::chrono::seconds(2)}, nobody);
  if (!joined) return;
  const auto writer = (*joined)->MakeWriter(kPictures, {});
  for (std::size_t i = 0; writer; ++i) {
    auto octets = std::make_shared<Octets>(100'000, std::byte(i));
    (*octets)[0] = (*octets)[2] = (*octets)[3] = std::byte{0};
    (*octets)[1] = std::byte{1};
    if (!(*writer)->Write(octets, 1)) return;
    usleep(5000);
  }
}

// Told 's' or 'o', it says so when the next value has come by shared memory, or as octets; 'x' if one is torn.
void ReadPictures(MakeEngine make, unsigned domain, int from, int to) {
  char told = 0;
  if (read(from, &told, 1) != 1) return;
  std::atomic<char> wanted{told};
  Nobody nobody;
  const auto engine = MakeSharedMemoryWire(make());
  const auto joined = engine->Join({.domain = domain, .lease = std::chrono::seconds(2)}, nobody);
  if (!joined) return;
  const auto reader = (*joined)->MakeReader(kPictures,
                                            [&](const WireSample& sample) {
                                              if (!sample.flaw.empty()) return;
                                              for (std::size_t i = 5; i < sample.octets.size(); ++i) {
                                                if (sample.octets[i] != sample.octets[4]) (void)Tell(to, 'x');
                                              }
                                              char has_come = sample.holder != nullptr ? 's' : 'o';
                                              if (wanted.compare_exchange_strong(has_come, '\0'))
                                                (void)Tell(to, has_come);
                                            },
                                            {});
  while (reader && read(from, &told, 1) == 1) wanted = told;
}

class OfTwoUsersTest : public testing::TestWithParam<MakeEngine> {};

TEST_P(OfTwoUsersTest, ValuesComeToBothAndSharedMemoryServesOne) {
  if (geteuid() != 0) GTEST_SKIP() << "needs the right to be other users";
  const unsigned domain = OwnDomain();
  const MakeEngine make = GetParam();
  const Child writer([&](int from, int) { WritePictures(make, domain, from); }, kOne);
  const Child same([&](int from, int to) { ReadPictures(make, domain, from, to); }, kOne);
  Child other([&](int from, int to) { ReadPictures(make, domain, from, to); }, kAnother);
  const auto expect = [](const Child& reader, char what) {
    ASSERT_TRUE(Tell(reader.to(), what));
    EXPECT_EQ(reader.Said(), what);
  };
  ASSERT_TRUE(Tell(writer.to(), 'w'));
  expect(same, 's');
  expect(other, 'o');
  expect(same, 'o');
  other.Kill();
  expect(same, 's');  // when its lease is over
}

INSTANTIATE_TEST_SUITE_P(Cyclone, OfTwoUsersTest, testing::Values(&MakeCycloneWire));
#ifdef RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, OfTwoUsersTest, testing::Values(&MakeFastWire));
#endif

}  // namespace
}  // namespace runnel::test
