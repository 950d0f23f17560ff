#include "tests/support/lock_probe.h"

#include <atomic>

#include <dlfcn.h>
#include <pthread.h>

#include "tests/support/sanitizer.h"

namespace {
thread_local constinit std::size_t locks = 0;
}  // namespace

#if !RUNNEL_UNDER_SANITIZER

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

#define RUNNEL_PROBE_LOCK(function, Type)                        \
  extern "C" int function(Type* lock) noexcept {                 \
    static constinit std::atomic<int (*)(Type*)> known{nullptr}; \
    ++locks;                                                     \
    return Next(known, #function)(lock);                         \
  }
RUNNEL_PROBE_LOCK(pthread_mutex_lock, pthread_mutex_t)
RUNNEL_PROBE_LOCK(pthread_mutex_trylock, pthread_mutex_t)
RUNNEL_PROBE_LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
RUNNEL_PROBE_LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
RUNNEL_PROBE_LOCK(pthread_rwlock_tryrdlock, pthread_rwlock_t)
RUNNEL_PROBE_LOCK(pthread_rwlock_trywrlock, pthread_rwlock_t)
#undef RUNNEL_PROBE_LOCK

#endif

namespace runnel::test {

LockProbe::LockProbe() noexcept : locks_before_(::locks) {}
bool LockProbe::works() noexcept { return !RUNNEL_UNDER_SANITIZER; }
std::size_t LockProbe::locks() const noexcept { return ::locks - locks_before_; }

}  // namespace runnel::test
