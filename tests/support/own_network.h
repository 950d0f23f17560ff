#pragma once

#include <cstring>

#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace runnel::test {

/// A network of one's own, in which there is nothing but the loopback interface: what the calling thread and those
/// that it makes from now on send, and the processes that they start, reaches nobody else's tests. False: the system
/// does not permit it, to users other than root.
inline bool EnterOwnNetwork() {
  if (unshare(CLONE_NEWNET) != 0) return false;
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return false;
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  const bool is_known = ioctl(descriptor, SIOCGIFFLAGS, &request) == 0;
  request.ifr_flags = static_cast<short>(request.ifr_flags | IFF_UP);
  const bool is_up = is_known && ioctl(descriptor, SIOCSIFFLAGS, &request) == 0;
  close(descriptor);
  return is_up;
}

/// A domain that is likely to be nobody else's: 0 in a network of one's own, else one that follows from the process.
inline unsigned OwnDomain() {
  static const unsigned domain = EnterOwnNetwork() ? 0u : 1u + static_cast<unsigned>(getpid()) % 100u;
  return domain;
}

}  // namespace runnel::test
