#include "plugins/scheduling/realtime_setup.h"

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string>

#include <sys/mman.h>
#include <sys/resource.h>

namespace runnel {

std::optional<Error> UseScheduling(pthread_t thread, int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int failure =
      pthread_setschedparam(thread, priority > 0 ? SCHED_FIFO : SCHED_OTHER, &parameters);
  if (failure == 0) return {};
  return Error{.message = "SCHED_FIFO with priority " + std::to_string(priority) +
                          " was refused (" + std::strerror(failure) +
                          "); the thread runs under ordinary scheduling",
               .hint = "allow it with CAP_SYS_NICE or an rtprio limit (limits.conf)"};
}

std::optional<Error> LockMemory() {
  const char* const hint = "allow it with CAP_IPC_LOCK and an unlimited memlock (limits.conf)";
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  const bool unlimited = limit.rlim_cur == RLIM_INFINITY;
  if (mlockall(unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) != 0) {
    return Error{.message = std::string("memory was not locked (") + std::strerror(errno) +
                            "); cycles may wait for pages",
                 .hint = hint};
  }
  if (unlimited) return {};
  return Error{.message = "only the memory in use now was locked, since locked memory is limited",
               .hint = hint};
}

void PrefaultStack() noexcept {
  constexpr std::size_t kBytes = 128 * 1024;
  constexpr std::size_t kPage = 4096;
  std::byte stack[kBytes];
  volatile std::byte* const touched = stack;  // volatile: the stores have no other purpose
  for (std::size_t i = 0; i < kBytes; i += kPage) touched[i] = std::byte{0};
}

}  // namespace runnel
