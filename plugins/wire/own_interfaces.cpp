#include "plugins/wire/own_interfaces.h"

#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>

namespace runnel {

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

}  // namespace runnel
