// Which sockets of the process an engine filters when a member joins.

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <linux/filter.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/plugins/wire/wire_ends.h"
#include "tests/support/own_network.h"
#ifdef RUNNEL_HAS_CYCLONE
#include "plugins/wire_cyclone/cyclone_wire.h"
#endif
#ifdef RUNNEL_HAS_FAST
#include "plugins/wire_fast/fast_wire.h"
#endif

namespace runnel::test {
namespace {

using MakeEngine = std::shared_ptr<WireEngine> (*)();

class EngineSocketsTest : public testing::TestWithParam<MakeEngine> {
 protected:
  /// The sockets of this process that others than this machine could send to, by where they listen.
  static std::map<int, sockaddr_in> OpenSockets() {
    std::map<int, sockaddr_in> found;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      const int descriptor = std::atoi(entry.path().filename().c_str());
      sockaddr_in address{};
      socklen_t size = sizeof address;
      if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0 || address.sin_family != AF_INET)
        continue;
      if (address.sin_addr.s_addr != htonl(INADDR_LOOPBACK)) found[descriptor] = address;
    }
    return found;
  }
  static bool IsFiltered(int descriptor) {
    sock_filter filter[8];
    socklen_t length = 8;
    return getsockopt(descriptor, SOL_SOCKET, SO_GET_FILTER, filter, &length) == 0 && length > 0;
  }

  const unsigned domain_ = OwnDomain();  // before the engine's threads
  const std::shared_ptr<WireEngine> engine_ = GetParam()();
  Members members_;
};

TEST_P(EngineSocketsTest, NobodyButThisMachineReachesALoopback) {
  const auto member = engine_->Join({.domain = domain_}, members_);
  ASSERT_TRUE(member);
  const auto open = OpenSockets();
  for (const auto& [descriptor, address] : open) EXPECT_TRUE(IsFiltered(descriptor)) << ntohs(address.sin_port);
  EXPECT_GE(open.size(), 1u);
}

// A lidar's driver listens at a port of the domain's before the application joins.
TEST_P(EngineSocketsTest, SocketsThatAreNoneOfTheEnginesStayOpenToAll) {
  const int sensor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain_ + 102));
  ASSERT_EQ(bind(sensor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (const WireReach reach : {WireReach::kLoopback, WireReach::kMachine}) {
    const auto member = engine_->Join({.domain = domain_, .reach = reach}, members_);
    ASSERT_TRUE(member);
    EXPECT_FALSE(IsFiltered(sensor));
  }
  close(sensor);
}

TEST_P(EngineSocketsTest, WhoJoinsWithAnotherReachLeavesTheSocketsOfTheFirstAsTheyAre) {
  const auto first = engine_->Join({.domain = domain_, .reach = WireReach::kNetwork}, members_);
  ASSERT_TRUE(first);
  const auto open = OpenSockets();
  ASSERT_FALSE(open.empty());
  const auto second = engine_->Join({.domain = domain_}, members_);  // which an engine may refuse
  for (const auto& [descriptor, address] : open) EXPECT_FALSE(IsFiltered(descriptor)) << ntohs(address.sin_port);
}

/// A further address of the loopback interface, as others have them: what is sent to 127.0.0.1 does not come there.
class FurtherAddress {
 public:
  explicit FurtherAddress(const char* address) {
    std::strcpy(request_.ifr_name, "lo:1");
    auto& internet = reinterpret_cast<sockaddr_in&>(request_.ifr_addr);
    internet.sin_family = AF_INET;
    inet_pton(AF_INET, address, &internet.sin_addr);
    is_there_ = ioctl(socket_, SIOCSIFADDR, &request_) == 0;
  }
  ~FurtherAddress() {
    request_.ifr_flags = 0;
    if (is_there_) (void)ioctl(socket_, SIOCSIFFLAGS, &request_);
    close(socket_);
  }
  FurtherAddress(const FurtherAddress&) = delete;
  FurtherAddress& operator=(const FurtherAddress&) = delete;
  [[nodiscard]] bool is_there() const noexcept { return is_there_; }

 private:
  const int socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request_{};
  bool is_there_ = false;
};

TEST_P(EngineSocketsTest, ThoseOfOneMachineMeetByOneInterfaceWithoutMulticast) {
  constexpr const char* kAddress = "10.9.8.7";
  if (domain_ != 0) GTEST_SKIP() << "no network of one's own";
  const FurtherAddress address(kAddress);
  ASSERT_TRUE(address.is_there());
  Members others;
  const auto join = [&](Members& members, const std::string& name) {
    return engine_->Join({.reach = WireReach::kNetwork, .has_multicast = false, .interface = kAddress, .name = name},
                         members);
  };
  const auto first = join(members_, "first");
  const auto second = join(others, "second");
  ASSERT_TRUE(first && second) << (first ? second : first).error().ToString();
  const auto writer = (*first)->MakeWriter({.topic = "rt/four", .type = "numbers::Four"}, {});
  Arrived arrived;
  const auto reader = (*second)->MakeReader({.topic = "rt/four", .type = "numbers::Four"}, arrived.Taker(), {});
  ASSERT_TRUE(writer && reader);
  WaitUntil("a value has come", [&] {
    EXPECT_TRUE((*writer)->Write(Four(1), 1));
    const std::lock_guard lock(arrived.mutex);
    return !arrived.values.empty();
  });
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EngineSocketsTest);
#ifdef RUNNEL_HAS_CYCLONE
INSTANTIATE_TEST_SUITE_P(Cyclone, EngineSocketsTest, testing::Values(&MakeCycloneWire));
#endif
#ifdef RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, EngineSocketsTest, testing::Values(&MakeFastWire));
#endif

}  // namespace
}  // namespace runnel::test
