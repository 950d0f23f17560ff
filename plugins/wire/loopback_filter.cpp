#include "plugins/wire/loopback_filter.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <arpa/inet.h>
#include <linux/filter.h>
#include <netinet/in.h>
#include <sys/socket.h>

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
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0 || address.sin_family != AF_INET) return false;
  const int first = kFirstPort + kPortsOfDomain * static_cast<int>(domain);
  const int port = ntohs(address.sin_port);
  return port >= first && port < first + kPortsOfDomain && address.sin_addr.s_addr != htonl(INADDR_LOOPBACK);
}

// Where a datagram comes from is in the header of the network below it; 127.x.y.z passes, which the kernel takes from
// nobody else.
bool Filter(int socket) {
  constexpr std::uint32_t kSource = 12;  // in the header
  std::array<sock_filter, 4> program = {{{BPF_LD | BPF_B | BPF_ABS, 0, 0, static_cast<std::uint32_t>(SKF_NET_OFF) + kSource},
                                         {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, IN_LOOPBACKNET},
                                         {BPF_RET | BPF_K, 0, 0, 0xffffffff},
                                         {BPF_RET | BPF_K, 0, 0, 0}}};
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0;
}

}  // namespace

Result<void> KeepToLoopback(std::uint32_t domain) {
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", failed)) {
    const int socket = std::atoi(entry.path().filename().c_str());
    if (!IsOpenPortOf(socket, domain) || Filter(socket)) continue;
    return Error{.message = std::string("the network cannot be kept to this machine: ") + std::strerror(errno)};
  }
  if (failed) return Error{.message = "the network cannot be kept to this machine: " + failed.message()};
  return {};
}

}  // namespace runnel
