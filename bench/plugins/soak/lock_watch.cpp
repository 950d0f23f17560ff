// Loaded before all else into a program (LD_PRELOAD), writes into the file RUNNEL_LOCK_WATCH how long mutexes are held:
// one line for each time that it was 5 ms or longer, "MILLISECONDS OBJECT:FUNCTION < OBJECT:FUNCTION …", from who lets go
// of it outwards. While a thread waits at a condition it holds none. What a thread that could have run had to wait for a
// processor is no fault of the one who holds the lock, and is not counted; how long that was is known to 20 ms.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <time.h>
#include <unistd.h>

namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kWorthTelling = 5 * kMillisecond;
constexpr std::int64_t kLookAtDelay = 20 * kMillisecond;
constexpr int kMostHeld = 64;
constexpr int kMostFrames = 24;

struct Held {
  const pthread_mutex_t* mutex;
  std::int64_t since;
  std::int64_t delay;  // of the thread until then
  int depth;
};
struct Thread {
  Held held[kMostHeld];
  int count;
  std::int64_t delay, looked_at;
  bool is_telling;
};
// Made with the thread, so that nothing is allocated at first use.
thread_local Thread thread __attribute__((tls_model("initial-exec")));

std::int64_t Now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

// For how long the thread could have run, and did not.
std::int64_t DelayOfThread() {
  char text[96] = {};
  const int file = open("/proc/thread-self/schedstat", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t size = read(file, text, sizeof text - 1);
  close(file);
  long long ran = 0, waited = 0;
  return size > 0 && std::sscanf(text, "%lld %lld", &ran, &waited) == 2 ? waited : 0;
}

template <typename Function>
Function Next(Function& known, const char* name, const char* version = nullptr) {
  if (known == nullptr && version != nullptr) known = reinterpret_cast<Function>(dlvsym(RTLD_NEXT, name, version));
  if (known == nullptr) known = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
  return known;
}

int File() {
  static const int file = [] {
    const char* const name = std::getenv("RUNNEL_LOCK_WATCH");
    return name != nullptr ? open(name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644) : -1;
  }();
  return file;
}

void Tell(std::int64_t held) {
  void* frames[kMostFrames];
  const int count = backtrace(frames, kMostFrames);
  char text[8000];
  int size = std::snprintf(text, sizeof text, "%.3f", static_cast<double>(held) / kMillisecond);
  for (int i = 3; i < count && size < 7000; ++i) {
    Dl_info known{};
    if (dladdr(frames[i], &known) == 0) continue;
    const char* const slash = std::strrchr(known.dli_fname, '/');
    int is_bad = 1;
    char* const name =
        known.dli_sname != nullptr ? abi::__cxa_demangle(known.dli_sname, nullptr, nullptr, &is_bad) : nullptr;
    size +=
        std::snprintf(text + size, sizeof text - static_cast<std::size_t>(size), "%s%s:%.150s", i == 3 ? " " : " < ",
                      slash != nullptr ? slash + 1 : known.dli_fname, name != nullptr ? name : "?");
    std::free(name);
  }
  text[size++] = '\n';
  (void)!write(File(), text, static_cast<std::size_t>(size));
}

void Took(const pthread_mutex_t* mutex) {
  Thread& own = thread;
  if (own.is_telling) return;
  for (int i = own.count - 1; i >= 0; --i) {
    if (own.held[i].mutex == mutex) {
      ++own.held[i].depth;
      return;
    }
  }
  if (own.count == kMostHeld) return;
  const std::int64_t now = Now();
  if (now - own.looked_at > kLookAtDelay) {
    own.looked_at = now;
    own.delay = DelayOfThread();
  }
  own.held[own.count++] = {mutex, now, own.delay, 1};
}

// Before it is let go.
[[gnu::noinline]] void LetsGo(const pthread_mutex_t* mutex, bool is_wholly) {
  Thread& own = thread;
  if (own.is_telling) return;
  for (int i = own.count - 1; i >= 0; --i) {
    if (own.held[i].mutex != mutex) continue;
    if (!is_wholly && --own.held[i].depth > 0) return;
    const Held held = own.held[i];
    std::memmove(own.held + i, own.held + i + 1, sizeof(Held) * static_cast<std::size_t>(own.count - i - 1));
    --own.count;
    std::int64_t time = Now() - held.since;
    if (time < kWorthTelling || File() < 0) return;
    time -= DelayOfThread() - held.delay;
    own.is_telling = true;
    if (time >= kWorthTelling) Tell(time);
    own.is_telling = false;
    return;
  }
}

int (*next_lock)(pthread_mutex_t*);
int (*next_try)(pthread_mutex_t*);
int (*next_unlock)(pthread_mutex_t*);
int (*next_wait)(pthread_cond_t*, pthread_mutex_t*);
int (*next_timed)(pthread_cond_t*, pthread_mutex_t*, const timespec*);
int (*next_clock)(pthread_cond_t*, pthread_mutex_t*, clockid_t, const timespec*);

template <typename Wait>
int WaitWithout(pthread_mutex_t* mutex, const Wait& wait) {
  LetsGo(mutex, true);
  const int done = wait();
  Took(mutex);
  return done;
}

// The first one loads what finds frames.
[[gnu::constructor]] void Begin() {
  void* frame = nullptr;
  (void)backtrace(&frame, 1);
  unsetenv("LD_PRELOAD");  // not for programs that it starts
}

}  // namespace

extern "C" {

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  const int done = Next(next_lock, "pthread_mutex_lock")(mutex);
  if (done == 0) Took(mutex);
  return done;
}
int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  const int done = Next(next_try, "pthread_mutex_trylock")(mutex);
  if (done == 0) Took(mutex);
  return done;
}
int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
  LetsGo(mutex, false);
  return Next(next_unlock, "pthread_mutex_unlock")(mutex);
}
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  return WaitWithout(mutex, [&] { return Next(next_wait, "pthread_cond_wait", "GLIBC_2.3.2")(condition, mutex); });
}
int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
  return WaitWithout(
      mutex, [&] { return Next(next_timed, "pthread_cond_timedwait", "GLIBC_2.3.2")(condition, mutex, until); });
}
int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* until) {
  return WaitWithout(mutex, [&] { return Next(next_clock, "pthread_cond_clockwait")(condition, mutex, clock, until); });
}

}  // extern "C"
