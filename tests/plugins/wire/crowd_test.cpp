// Many processes on one machine.

#include <array>
#include <csignal>
#include <mutex>
#include <set>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plugins/wire_cyclone/cyclone_wire.h"
#include "tests/support/own_network.h"

namespace runnel::test {
namespace {

constexpr int kProcesses = 10;

/// Counts the others.
class Others final : public WireDiscovery {
 public:
  [[nodiscard]] int count() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(ids_.size());
  }

 private:
  void OnMember(const WireMember& member) override {
    const std::lock_guard lock(mutex_);
    ids_.insert(member.id);
  }
  void OnMemberGone(const WireId&) override {}  // one may end before another has looked
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}

  mutable std::mutex mutex_;
  std::set<WireId> ids_;
};

// Says so when it knows all the others, and stays until `end` is closed.
[[noreturn]] void BeOneOfThem(unsigned domain, int say, int end) {
  (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
  Others others;
  const auto joined = MakeCycloneWire()->Join({.domain = domain}, others);
  if (!joined) _exit(1);
  while (others.count() < kProcesses) usleep(10'000);  // itself among them
  if (write(say, "x", 1) != 1) _exit(1);
  char octet = 0;
  (void)!read(end, &octet, 1);
  _exit(0);
}

TEST(CrowdTest, ManyProcessesKnowEachOther) {
  const unsigned domain = OwnDomain();
  std::array<int, 2> said{};
  std::array<int, 2> end{};
  ASSERT_EQ(pipe2(said.data(), O_CLOEXEC), 0);
  ASSERT_EQ(pipe2(end.data(), O_CLOEXEC), 0);
  std::vector<pid_t> processes;
  for (int i = 0; i < kProcesses; ++i) {
    const pid_t process = fork();
    if (process == 0) {
      close(end[1]);
      BeOneOfThem(domain, said[1], end[0]);
    }
    processes.push_back(process);
  }
  close(said[1]);
  int count = 0;
  for (; count < kProcesses; ++count) {
    constexpr int kPatience = 60'000;  // ms
    pollfd more{said[0], POLLIN, 0};
    char octet = 0;
    if (poll(&more, 1, kPatience) != 1 || read(said[0], &octet, 1) != 1) break;
  }
  EXPECT_EQ(count, kProcesses);
  close(end[1]);
  for (const pid_t each : processes) {
    if (count < kProcesses) kill(each, SIGKILL);
    waitpid(each, nullptr, 0);
  }
}

}  // namespace
}  // namespace runnel::test
