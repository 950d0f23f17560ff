#include "core/lockfree/asymmetric_fence.h"

#include <linux/membarrier.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace runnel {

namespace {

bool Register() noexcept { return syscall(SYS_membarrier, MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED, 0, 0) == 0; }
bool PassFenceEverywhere() noexcept { return syscall(SYS_membarrier, MEMBARRIER_CMD_PRIVATE_EXPEDITED, 0, 0) == 0; }

// Runs the calling thread on each processor in turn. Whatever has run there was switched away for it,
// and that is a full fence. Milliseconds, where the kernel's own way takes microseconds.
void VisitEachProcessor() noexcept {
  cpu_set_t own;
  if (sched_getaffinity(0, sizeof own, &own) != 0) return;
  for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(processor, &one);
    (void)sched_setaffinity(0, sizeof one, &one);  // fails for those that there are not
  }
  (void)sched_setaffinity(0, sizeof own, &own);
}

}  // namespace

// Until this is initialised it is false, and then every fence is a full one.
bool internal::heavy_fence_is_heavy = Register();

void HeavyFence() noexcept {
  FullFence();
  if (!internal::heavy_fence_is_heavy || PassFenceEverywhere()) return;
  // A process that has been forked since is no longer registered.
  if (Register() && PassFenceEverywhere()) return;
  // Refused from now on, as by a filter of system calls that was set up later. Light fences stay
  // light: other threads may be past the question whether they are.
  VisitEachProcessor();
}

}  // namespace runnel
