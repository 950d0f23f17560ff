// What processes of the same user may do at the socket by which memory is handed out, and what they may hand out.

#include <array>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "plugins/wire_shared_memory/segment_server.h"
#include "tests/support/held_resources.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

std::string HexOf(const SegmentId& id) {
  std::string text;
  for (const std::byte each : id) {
    std::array<char, 3> digits{};
    (void)std::snprintf(digits.data(), digits.size(), "%02x", std::to_integer<unsigned>(each));
    text += digits.data();
  }
  return text;
}

sockaddr_un AddressOf(const std::string& name, socklen_t& size) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, name.data(), name.size());
  size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

// The name of the socket of this server, as the system tells everybody.
std::string SocketOf(const SegmentId& server) {
  std::ifstream file("/proc/net/unix");
  for (std::string line; std::getline(file, line);) {
    const std::size_t begin = line.find('@');
    if (begin != std::string::npos && line.ends_with(HexOf(server))) return line.substr(begin + 1);
  }
  return {};
}

FileDescriptor ConnectedTo(const std::string& name) {
  FileDescriptor connected(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  socklen_t size = 0;
  const sockaddr_un address = AddressOf(name, size);
  EXPECT_EQ(connect(connected.number(), reinterpret_cast<const sockaddr*>(&address), size), 0);
  return connected;
}

TEST(HostileSocketTest, WhoAsksForNonsenseKeepsNobodyFromTheMemory) {
  const auto server = SegmentServer::Start();
  ASSERT_TRUE(server);
  const auto segment = WrittenSegment::Make(1000);
  ASSERT_TRUE(segment);
  SegmentPlace place = *(*segment)->Put(Octets(1000));
  place.server = (*server)->id();
  (*server)->Offer(**segment);
  const std::string name = SocketOf((*server)->id());
  ASSERT_FALSE(name.empty());
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const FileDescriptor connected = ConnectedTo(name);
    std::string octets(random() % (i % 10 == 0 ? 60'000 : 40), '\0');
    for (char& each : octets) each = static_cast<char>(random());
    if (i % 3 != 0) (void)send(connected.number(), octets.data(), octets.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  const FileDescriptor silent = ConnectedTo(name);  // and stays
  WaitUntil("the memory is handed out", [&] {
    const auto fetched = FetchSegment(place);
    return fetched && (*fetched)->Hold(place) != nullptr;
  });
}

TEST(HostileSocketTest, MemoryThatIsNoneOfAWriterIsNotTaken) {
  SegmentPlace place{.server = NewSegmentId(), .segment = NewSegmentId(), .use = 2, .size = 1000, .slot = 0};
  // As a server of another's making.
  const FileDescriptor listening(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  socklen_t size = 0;
  const sockaddr_un address = AddressOf("runnel-segments-" + HexOf(place.server), size);
  ASSERT_EQ(bind(listening.number(), reinterpret_cast<const sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(listening.number(), 8), 0);

  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe2(pipe_ends.data(), O_CLOEXEC), 0);
  const FileDescriptor reading(pipe_ends[0]);
  const FileDescriptor writing(pipe_ends[1]);
  const FileDescriptor folder(open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const FileDescriptor zero(open("/dev/zero", O_RDWR | O_CLOEXEC));
  const FileDescriptor can_shrink(memfd_create("other", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  const FileDescriptor empty(memfd_create("other", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  const FileDescriptor nonsense(memfd_create("other", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  ASSERT_EQ(ftruncate(can_shrink.number(), 100'000), 0);
  ASSERT_EQ(ftruncate(nonsense.number(), 100'000), 0);
  const std::string ones(100'000, '\xff');
  ASSERT_EQ(pwrite(nonsense.number(), ones.data(), ones.size(), 0), 100'000);
  for (const FileDescriptor* const each : {&empty, &nonsense})
    ASSERT_EQ(fcntl(each->number(), F_ADD_SEALS, F_SEAL_SHRINK), 0);

  const auto table = HoldTable::Make();
  const auto segment = WrittenSegment::Make(1000);
  ASSERT_TRUE(table && segment);
  const auto fetch = [&](const std::vector<int>& files) {
    std::thread answering([&] {
      const FileDescriptor asking(accept4(listening.number(), nullptr, nullptr, SOCK_CLOEXEC));
      SegmentId wanted{};  // who has gone before it is asked is not listened to
      EXPECT_EQ(recv(asking.number(), wanted.data(), wanted.size(), 0), static_cast<ssize_t>(wanted.size()));
      char octet = 0;
      iovec part{&octet, 1};
      const std::size_t octets = files.size() * sizeof(int);
      alignas(cmsghdr) std::array<char, CMSG_SPACE(3 * sizeof(int))> control{};
      msghdr message{};
      message.msg_iov = &part;
      message.msg_iovlen = 1;
      if (!files.empty()) {
        message.msg_control = control.data();
        message.msg_controllen = CMSG_SPACE(octets);
        cmsghdr* const head = CMSG_FIRSTHDR(&message);
        head->cmsg_level = SOL_SOCKET;
        head->cmsg_type = SCM_RIGHTS;
        head->cmsg_len = CMSG_LEN(octets);
        std::memcpy(CMSG_DATA(head), files.data(), octets);
      }
      EXPECT_GT(sendmsg(asking.number(), &message, MSG_NOSIGNAL), 0);
    });
    const auto fetched = FetchSegment(place);
    answering.join();
    return fetched && (*fetched)->Hold(place) != nullptr;
  };
  for (const FileDescriptor* const given : {&reading, &folder, &zero, &can_shrink, &empty, &nonsense}) {
    EXPECT_FALSE(fetch({given->number(), (*table)->descriptor()}));
    if (given != &nonsense) {
      EXPECT_FALSE(fetch({(*segment)->descriptor(), given->number()}));
    }
  }
  const std::size_t before = HeldResources().files;
  for (std::size_t count = 0; count <= 3; ++count) {
    if (count != 2) {
      EXPECT_FALSE(fetch(std::vector<int>(count, (*segment)->descriptor())));
    }
  }
  EXPECT_EQ(HeldResources().files, before) << "what has been sent is closed";
  // What is given is not believed; that it could be is seen here.
  const auto right = (*segment)->Put(Octets(1000));
  ASSERT_TRUE(right);
  place.use = right->use;
  place.slot = right->slot;
  EXPECT_TRUE(fetch({(*segment)->descriptor(), (*table)->descriptor()}));
}

}  // namespace
}  // namespace runnel::test
