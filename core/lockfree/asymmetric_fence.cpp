#include "core/lockfree/asymmetric_fence.h"

#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace runnel {

namespace {

bool Register() noexcept {
  return syscall(SYS_membarrier, MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED, 0, 0) == 0;
}

}  // namespace

// Until this is initialised it is false, and then every fence is a full one.
bool internal::heavy_fence_is_heavy = Register();

void HeavyFence() noexcept {
  FullFence();
  if (!internal::heavy_fence_is_heavy) return;
  while (syscall(SYS_membarrier, MEMBARRIER_CMD_PRIVATE_EXPEDITED, 0, 0) != 0) {
    // Only a process that has been forked since is no longer registered.
    Register();
  }
}

}  // namespace runnel
