#pragma once

#include <atomic>
#include <cstdint>

namespace runnel {

/// Has a piece of work done by one thread at a time, without anybody waiting: who asks while another thread
/// is at it leaves it to that one, which does it once more.
///
/// Invariant: `asked_` is how often has been asked since the last time that it was 0; the thread that took it
/// from 0 to 1, and nobody else, works until it has brought it back to 0.
///
/// Threads:   any.
/// Progress:  wait-free for who leaves the work to another; who does it goes on as long as others ask.
/// Promise:   what a thread did before it asked is seen by a run of the work that begins afterwards, and each
///            run sees all that those before have done.
///
/// @tparam Atomic  replaced by the search over schedules.
template <template <typename> class Atomic = std::atomic>
class TakingTurns {
 public:
  /// `work` must not throw.
  template <typename Work>
  void Do(Work&& work) noexcept {
    // release: pairs with the acquire of the fetch_sub below, so that who is at it finds what the caller has
    // put down. acquire: pairs with its release, so that who begins sees what the last one has left.
    if (asked_.fetch_add(1, std::memory_order_acq_rel) != 0) return;
    std::uint32_t seen = 1;
    while (seen != 0) {
      work();
      // acquire: who has asked meanwhile has put something down; it is seen in the next run. release: hands
      // over to who takes it from 0 next.
      seen = asked_.fetch_sub(seen, std::memory_order_acq_rel) - seen;
    }
  }

 private:
  Atomic<std::uint32_t> asked_{0};
};

}  // namespace runnel
