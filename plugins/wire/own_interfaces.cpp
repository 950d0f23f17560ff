#include "plugins/wire/own_interfaces.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace runnel {

std::string AddressText(const sockaddr& address) {
  char text[INET_ADDRSTRLEN] = {};
  const auto& internet = reinterpret_cast<const sockaddr_in&>(address);
  return inet_ntop(AF_INET, &internet.sin_addr, text, sizeof text) != nullptr ? text : "";
}

bool IsInNetwork() {
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return true;  // who cannot know says nothing
  bool is_in_one = false;
  for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
    const bool has_address = each->ifa_addr != nullptr && each->ifa_addr->sa_family == AF_INET;
    is_in_one |= has_address && (each->ifa_flags & IFF_LOOPBACK) == 0 && (each->ifa_flags & IFF_UP) != 0;
  }
  freeifaddrs(all);
  return is_in_one;
}

Result<std::string> AddressOfInterface(const std::string& interface) {
  ifaddrs* all = nullptr;
  std::string found;
  std::string others;
  if (getifaddrs(&all) == 0) {
    for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
      if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
      const std::string address = AddressText(*each->ifa_addr);
      if (interface == each->ifa_name || interface == address) found = address;
      others += std::string(others.empty() ? "" : ", ") + each->ifa_name + " (" + address + ")";
    }
    freeifaddrs(all);
  }
  if (!found.empty()) return found;
  return Error{.message = "there is no interface '" + interface + "' with an address", .hint = "there are " + others};
}

}  // namespace runnel
