#pragma once

#include <thread>

namespace runnel::bench {

/// How all cases wait for the other thread: by asking again at once, and giving the core away when
/// the other side seems to have none. No `pause` instruction: after a few thousand of them a virtual
/// machine takes the core away for 50 us, and then that would be what is measured.
class Waiting {
 public:
  void Pause() {
    asm volatile("" ::: "memory");
    if (++pauses_ % kBeforeYielding == 0) std::this_thread::yield();
  }

 private:
  static constexpr unsigned kBeforeYielding = 10'000;
  unsigned pauses_ = 0;
};

/// Some hundred nanoseconds of doing nothing.
inline void Idle(unsigned turns) {
  for (; turns > 0; --turns) asm volatile("" ::: "memory");
}

}  // namespace runnel::bench
