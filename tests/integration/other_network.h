#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "tests/integration/program.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

/// As sh -c; false if it fails.
inline bool RunsWell(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

/// The network of another machine, as far as programs see, with nothing in it at first. Precondition: the calling thread is
/// in a network of its own (OwnDomain() is 0).
class OtherNetwork {
 public:
  OtherNetwork() {
    WaitUntil("it has a network of its own", [&] {
      std::error_code failed;
      return std::filesystem::read_symlink("/proc/" + std::to_string(process()) + "/ns/net", failed) !=
             std::filesystem::read_symlink("/proc/self/ns/net", failed);
    });
  }
  [[nodiscard]] pid_t process() const noexcept { return keeper_.process(); }
  /// Before a command that is to run there.
  [[nodiscard]] std::string within() const { return "nsenter -t " + std::to_string(process()) + " --net "; }

  /// A cable of this name from here, 10.77.`number`.1, to "end" there, 10.77.`number`.2; without multicast, two that refuse
  /// it. False: the system does not permit it.
  [[nodiscard]] bool Connect(const std::string& cable, int number = 0, bool has_multicast = true) const {
    const std::string net = "10.77." + std::to_string(number) + ".";
    const std::string multicast = has_multicast ? " multicast on" : " multicast off";
    return RunsWell("ip link add " + cable + " type veth peer name end") &&
           RunsWell("ip link set end netns " + std::to_string(process())) &&
           RunsWell("ip addr add " + net + "1/24 dev " + cable + " && ip link set " + cable + multicast + " up") &&
           RunsWell(within() + "ip addr add " + net + "2/24 dev end") &&
           RunsWell(within() + "ip link set end" + multicast + " up") && RunsWell(within() + "ip link set lo up");
  }

 private:
  const Program keeper_{"--net sleep 1000", "unshare"};
};

}  // namespace runnel::test
