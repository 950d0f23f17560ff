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

/// Doing nothing for about a nanosecond a turn.
inline void Idle(unsigned turns) {
  for (; turns > 0; --turns) asm volatile("" ::: "memory");
}

/// Waiting for a queue: longer each time it is in vain, so that what waits at the other end can
/// become several. Else the two threads take turns with every message, and the time that a cache
/// line needs from core to core is all that is measured.
class PatientWaiting {
 public:
  void Pause() {
    Idle(turns_);
    if (turns_ < kMostTurns) {
      turns_ *= 2;
    } else if (++in_vain_ % kBeforeYielding == 0) {
      std::this_thread::yield();
    }
  }
  void Succeeded() {
    turns_ = kFewestTurns;
    in_vain_ = 0;
  }

 private:
  static constexpr unsigned kFewestTurns = 32;
  static constexpr unsigned kMostTurns = 1024;
  static constexpr unsigned kBeforeYielding = 16;
  unsigned turns_ = kFewestTurns;
  unsigned in_vain_ = 0;
};

}  // namespace runnel::bench
