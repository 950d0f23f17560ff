#include "plugins/wire/reach_filter.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <linux/filter.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>

namespace runnel {

namespace {

constexpr int kFirstPort = 7400;
constexpr int kPortsOfDomain = 250;

bool IsOpenPortOf(int socket, std::uint32_t domain) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_in address{};
  size = sizeof address;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0 || address.sin_family != AF_INET)
    return false;
  const int first = kFirstPort + kPortsOfDomain * static_cast<int>(domain);
  const int port = ntohs(address.sin_port);
  return port >= first && port < first + kPortsOfDomain && address.sin_addr.s_addr != htonl(INADDR_LOOPBACK);
}

// Sockets of this process that are open at ports of the domain, each by the number that no later one has.
std::map<ino_t, int> OpenSockets(std::uint32_t domain, std::error_code& failed) {
  std::map<ino_t, int> open;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", failed)) {
    const int socket = std::atoi(entry.path().filename().c_str());
    struct stat status {};
    if (IsOpenPortOf(socket, domain) && fstat(socket, &status) == 0) open[status.st_ino] = socket;
  }
  return open;
}

using FilterProgram = std::vector<sock_filter>;

// What `load` finds passes if it is one of these.
FilterProgram OnlyIf(int load, std::uint32_t offset, const std::vector<std::uint32_t>& allowed) {
  FilterProgram program = {BPF_STMT(static_cast<std::uint16_t>(load), offset)};
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    program.push_back(
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, allowed[i], static_cast<std::uint8_t>(allowed.size() - i), 0));
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, 0));
  program.push_back(BPF_STMT(BPF_RET | BPF_K, 0xffffffff));
  return program;
}

// Where a datagram comes from is in the header of the network below it; the kernel takes 127.x.y.z from nobody else.
FilterProgram OnlyLoopbackAddresses() {
  constexpr std::uint32_t kSource = 12;  // in the header
  return OnlyIf(BPF_LD | BPF_B | BPF_ABS, static_cast<std::uint32_t>(SKF_NET_OFF) + kSource, {IN_LOOPBACKNET});
}

// What one process of a machine sends to another comes by the loopback interface, whichever addresses both have.
FilterProgram OnlyInterfaces(std::vector<std::uint32_t> indices) {
  indices.push_back(if_nametoindex("lo"));
  return OnlyIf(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_IFINDEX), indices);
}

// Calls `use` with each address of IPv4 that an interface has. False: the system does not say.
template <typename Use>
bool ForEachAddress(const Use& use) {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return false;
  for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr != nullptr && each->ifa_addr->sa_family == AF_INET) use(*each);
  }
  freeifaddrs(all);
  return true;
}

// By its name or its address; 0: there is none.
std::uint32_t IndexOfInterface(const std::string& interface) {
  std::uint32_t found = if_nametoindex(interface.c_str());
  in_addr wanted{};
  if (found != 0 || inet_pton(AF_INET, interface.c_str(), &wanted) != 1) return found;
  (void)ForEachAddress([&](const ifaddrs& each) {
    if (reinterpret_cast<const sockaddr_in*>(each.ifa_addr)->sin_addr.s_addr == wanted.s_addr)
      found = if_nametoindex(each.ifa_name);
  });
  return found;
}

bool Filter(int socket, FilterProgram& program) {
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0;
}

// What came before its filter, taken by the engine's thread. What comes through the filter does no harm, so it need not be
// waited for without end.
void WaitUntilEmpty(int socket) {
  constexpr int kMostLooks = 1000;
  int waiting = 0;
  for (int i = 0; i < kMostLooks && ioctl(socket, FIONREAD, &waiting) == 0 && waiting > 0; ++i) {
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

}  // namespace

Result<void> KeepWithinReach(const WireMemberOptions& options, const std::function<void()>& open) {
  static std::mutex opening;  // of all engines: nobody takes the sockets of another for its own
  const std::lock_guard one(opening);
  std::error_code failed;
  const auto before = OpenSockets(options.domain, failed);
  open();
  FilterProgram program;
  if (options.reach == WireReach::kLoopback) {
    program = OnlyLoopbackAddresses();
  } else if (options.reach == WireReach::kMachine) {
    program = OnlyInterfaces({});
  } else if (!options.interface.empty()) {
    const std::uint32_t index = IndexOfInterface(options.interface);
    if (index == 0) return Error{.message = "there is no interface '" + options.interface + "'"};
    program = OnlyInterfaces({index});
  } else {
    return {};
  }
  const Error failure{.message = "the network cannot be kept to what it is to reach"};
  if (failed) return Error{.message = failure.message + ": " + failed.message()};
  for (const auto& [number, socket] : OpenSockets(options.domain, failed)) {
    if (before.contains(number)) continue;
    if (!Filter(socket, program)) return Error{.message = failure.message + ": " + std::strerror(errno)};
    WaitUntilEmpty(socket);
  }
  if (failed) return Error{.message = failure.message + ": " + failed.message()};
  return {};
}

std::string AddressText(const sockaddr& address) {
  char text[INET_ADDRSTRLEN] = {};
  const auto& internet = reinterpret_cast<const sockaddr_in&>(address);
  return inet_ntop(AF_INET, &internet.sin_addr, text, sizeof text) != nullptr ? text : "";
}

bool IsInNetwork() {
  bool is_in_one = false;
  const bool is_known = ForEachAddress([&](const ifaddrs& each) {
    is_in_one |= (each.ifa_flags & IFF_LOOPBACK) == 0 && (each.ifa_flags & IFF_UP) != 0;
  });
  return is_in_one || !is_known;  // who cannot know says nothing
}

Result<std::string> AddressOfInterface(const std::string& interface) {
  std::string found;
  std::string others;
  (void)ForEachAddress([&](const ifaddrs& each) {
    const std::string address = AddressText(*each.ifa_addr);
    if (interface == each.ifa_name || interface == address) found = address;
    others += std::string(others.empty() ? "" : ", ") + each.ifa_name + " (" + address + ")";
  });
  if (!found.empty()) return found;
  return Error{.message = "there is no interface '" + interface + "' with an address", .hint = "there are " + others};
}

}  // namespace runnel
