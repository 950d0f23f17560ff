#pragma once

#include <thread>

namespace runnel::bench {

/// How all cases wait for the other thread: politely to a sibling on the same core, and giving the
/// core away when the other side seems to have none.
class Waiting {
 public:
  void Pause() {
    if (++pauses_ % kBeforeYielding == 0) {
      std::this_thread::yield();
    } else {
      Relax();
    }
  }
  static void Relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
  }

 private:
  static constexpr unsigned kBeforeYielding = 2000;
  unsigned pauses_ = 0;
};

}  // namespace runnel::bench
