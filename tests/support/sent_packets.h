#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

namespace runnel::test {

/// The packets of the internet protocol that leave by an interface of the calling thread's network, from now on.
class SentPackets {
 public:
  explicit SentPackets(const std::string& interface)
      : socket_(socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_ll address{};
    address.sll_family = AF_PACKET;
    address.sll_protocol = htons(ETH_P_ALL);  // of one protocol, only what comes would be told
    address.sll_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
    is_there_ =
        address.sll_ifindex != 0 && bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~SentPackets() { close(socket_); }
  SentPackets(const SentPackets&) = delete;
  SentPackets& operator=(const SentPackets&) = delete;

  /// False: the system does not permit it.
  [[nodiscard]] bool is_there() const noexcept { return is_there_; }
  /// "to 239.255.0.1 of protocol 17", of each since the last time.
  std::vector<std::string> Take() {
    std::vector<std::string> all;
    for (;;) {
      std::array<unsigned char, 64> head{};
      sockaddr_ll from{};
      socklen_t size = sizeof from;
      if (recvfrom(socket_, head.data(), head.size(), 0, reinterpret_cast<sockaddr*>(&from), &size) < 0) return all;
      if (from.sll_pkttype != PACKET_OUTGOING || ntohs(from.sll_protocol) != ETH_P_IP) continue;
      std::array<char, INET_ADDRSTRLEN> text{};
      inet_ntop(AF_INET, &head[16], text.data(), text.size());
      all.push_back("to " + std::string(text.data()) + " of protocol " + std::to_string(head[9]));
    }
  }

 private:
  const int socket_;
  bool is_there_ = false;
};

}  // namespace runnel::test
