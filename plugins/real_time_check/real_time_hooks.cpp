#include "plugins/real_time_check/real_time_hooks.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <utility>

#include <dlfcn.h>
#include <pthread.h>

#include "plugins/real_time_check/sanitizer.h"

// Whoever has this in its program replaces the functions for all libraries.
#define RUNNEL_REPLACES extern "C" __attribute__((visibility("default")))

namespace runnel {

namespace {

// Plain words in the thread's own block, which need no initialisation and hence no allocation at first use.
#define RUNNEL_OF_THREAD thread_local constinit __attribute__((tls_model("initial-exec")))
RUNNEL_OF_THREAD RealTimeHooks::Counts counts;
RUNNEL_OF_THREAD RealTimeHooks::Listener listener = nullptr;
RUNNEL_OF_THREAD bool is_within = false;
#undef RUNNEL_OF_THREAD

// What the C library does within such a function, or the listener, is no act of its own.
class Act {
 public:
  // The address is that of whoever calls the function in which this is constructed.
  Act(RealTimeOffence offence, std::size_t& count, const char* function,
      const void* caller = __builtin_return_address(0)) noexcept {
    ++count;
    if (listener == nullptr) return;
    paused_ = std::exchange(listener, nullptr);
    is_within = true;
    paused_(offence, function, caller);
  }
  ~Act() {
    if (paused_ == nullptr) return;
    listener = paused_;
    is_within = false;
  }
  Act(const Act&) = delete;
  Act& operator=(const Act&) = delete;

 private:
  RealTimeHooks::Listener paused_ = nullptr;
};

}  // namespace

}  // namespace runnel

#if !RUNNEL_UNDER_SANITIZER

using runnel::Act;
using runnel::counts;
using runnel::RealTimeOffence;

// glibc's own names for what is replaced below. NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}  // NOLINTEND(bugprone-reserved-identifier)

RUNNEL_REPLACES void* malloc(std::size_t size) {
  const Act act(RealTimeOffence::kAllocation, counts.allocations, "malloc");
  return __libc_malloc(size);
}
RUNNEL_REPLACES void* calloc(std::size_t count, std::size_t size) {
  const Act act(RealTimeOffence::kAllocation, counts.allocations, "calloc");
  return __libc_calloc(count, size);
}
RUNNEL_REPLACES void* realloc(void* block, std::size_t size) {
  const Act act(RealTimeOffence::kAllocation, counts.allocations, "realloc");
  return __libc_realloc(block, size);
}
RUNNEL_REPLACES void* memalign(std::size_t alignment, std::size_t size) {
  const Act act(RealTimeOffence::kAllocation, counts.allocations, "memalign");
  return __libc_memalign(alignment, size);
}
RUNNEL_REPLACES void* aligned_alloc(std::size_t alignment, std::size_t size) {
  const Act act(RealTimeOffence::kAllocation, counts.allocations, "aligned_alloc");
  return __libc_memalign(alignment, size);
}
RUNNEL_REPLACES int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  const Act act(RealTimeOffence::kAllocation, counts.allocations, "posix_memalign");
  *block = __libc_memalign(alignment, size);
  return *block != nullptr ? 0 : ENOMEM;
}
RUNNEL_REPLACES void free(void* block) {
  if (block == nullptr) return;
  const Act act(RealTimeOffence::kRelease, counts.releases, "free");
  __libc_free(block);
}

namespace {

// The function that would have been called without us. Two threads may look it up at once and find
// the same.
template <typename Function>
Function* Next(std::atomic<Function*>& known, const char* name) {
  Function* next = known.load(std::memory_order_relaxed);
  if (next == nullptr) {
    next = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
    known.store(next, std::memory_order_relaxed);
  }
  return next;
}

}  // namespace

#define RUNNEL_REPLACE_LOCK(function, Type)                         \
  RUNNEL_REPLACES int function(Type* lock) noexcept {               \
    static constinit std::atomic<int (*)(Type*)> known{nullptr};    \
    const Act act(RealTimeOffence::kLock, counts.locks, #function); \
    return Next(known, #function)(lock);                            \
  }
RUNNEL_REPLACE_LOCK(pthread_mutex_lock, pthread_mutex_t)
RUNNEL_REPLACE_LOCK(pthread_mutex_trylock, pthread_mutex_t)
RUNNEL_REPLACE_LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
RUNNEL_REPLACE_LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
RUNNEL_REPLACE_LOCK(pthread_rwlock_tryrdlock, pthread_rwlock_t)
RUNNEL_REPLACE_LOCK(pthread_rwlock_trywrlock, pthread_rwlock_t)
#undef RUNNEL_REPLACE_LOCK

#endif

RUNNEL_REPLACES const runnel::RealTimeHooks* RunnelRealTimeHooks() noexcept {
  static constexpr runnel::RealTimeHooks hooks{
      .works = !RUNNEL_UNDER_SANITIZER,
      .counts = []() noexcept { return runnel::counts; },
      .Listen = [](runnel::RealTimeHooks::Listener heard) noexcept { runnel::listener = heard; },
      .is_within = []() noexcept { return runnel::is_within; }};
  return &hooks;
}
