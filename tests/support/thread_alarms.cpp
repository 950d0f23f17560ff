// With ThreadSanitizer, in each program: false alarms of what was built without it.
//
// Cyclone and Fast DDS: it sees their memory, not what orders their accesses. The loader: it does not see its lock, by which
// who finds a library loaded comes after who has loaded it.

#include <ctime>

#include <pthread.h>

extern "C" const char* __tsan_default_suppressions() {
  return "race:libddsc.so\nrace:libfastrtps.so\nrace:libfastcdr.so\ndeadlock:libfastrtps.so\nrace:OpenLibrary\n";
}

// That of GCC 12 does not know this call, by which Fast DDS takes its mutexes; it knows pthread_mutex_timedlock().
extern "C" int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock, const timespec* until) noexcept {
  constexpr long kNanoseconds = 1'000'000'000;
  timespec now{};
  timespec end{};
  (void)clock_gettime(clock, &now);
  (void)clock_gettime(CLOCK_REALTIME, &end);
  end.tv_sec += until->tv_sec - now.tv_sec;
  end.tv_nsec += until->tv_nsec - now.tv_nsec;
  if (end.tv_nsec < 0) --end.tv_sec, end.tv_nsec += kNanoseconds;
  if (end.tv_nsec >= kNanoseconds) ++end.tv_sec, end.tv_nsec -= kNanoseconds;
  return pthread_mutex_timedlock(mutex, &end);
}
