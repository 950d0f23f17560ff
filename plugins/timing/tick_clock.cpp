#include "plugins/timing/tick_clock.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace runnel {

bool MachineTicks::AreSteady() noexcept {
#if defined(__x86_64__)
  constexpr unsigned int kPowerManagement = 0x80000007;
  constexpr unsigned int kInvariantCounter = 1u << 8;
  unsigned int a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(kPowerManagement, &a, &b, &c, &d) != 0 && (d & kInvariantCounter) != 0;
#else
  return false;
#endif
}

}  // namespace runnel
