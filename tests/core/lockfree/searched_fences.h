#pragma once

// The fences of the lock-free structures, for the search over interleavings. Not to be included but
// by searched_atomic.h, which brings Relacy with it.

#include <algorithm>
#include <array>
#include <cstddef>

namespace runnel::test {

enum class FenceKind { kFull, kLight, kHeavy };

/// What Relacy lacks: fences of three kinds, of which two light ones do not order each other, nor a
/// light one and a full one. A light fence is no acquire or release fence either.
///
/// As in Relacy's own, who fences sees all that was done before the fences that came earlier: here,
/// before those of the kinds that it is ordered with. One of each suite that is run; the suite's
/// threads take turns, so plain members will do.
class SearchedFences {
 public:
  SearchedFences() { current() = this; }
  virtual ~SearchedFences() = default;
  static void Pass(FenceKind kind) {
    rl::ctx().sched();
    current()->PassOne(kind);
  }

 private:
  virtual void PassOne(FenceKind kind) = 0;
  static SearchedFences*& current() {
    static SearchedFences* fences = nullptr;
    return fences;
  }
};

/// For a suite of so many threads.
template <rl::thread_id_t kThreads>
class SearchedFencesOf : public SearchedFences {
 private:
  using Clock = std::array<rl::timestamp_t, kThreads>;

  void PassOne(FenceKind kind) override {
    auto& thread = static_cast<rl::thread_info<kThreads>&>(*rl::ctx().threadx_);
    const bool is_light = kind == FenceKind::kLight;
    if (!is_light) thread.atomic_thread_fence_acquire();
    Join(thread.acq_rel_order_, before_heavy_);
    if (!is_light) Join(thread.acq_rel_order_, before_full_);
    if (kind == FenceKind::kHeavy) Join(thread.acq_rel_order_, before_light_);
    Join(Before(kind), thread.acq_rel_order_);
    if (!is_light) thread.atomic_thread_fence_release();
  }
  template <typename To, typename From>
  static void Join(To& to, const From& from) {
    for (std::size_t i = 0; i < kThreads; ++i) to[i] = std::max(to[i], from[i]);
  }
  Clock& Before(FenceKind kind) {
    if (kind == FenceKind::kFull) return before_full_;
    return kind == FenceKind::kLight ? before_light_ : before_heavy_;
  }

  Clock before_full_{}, before_light_{}, before_heavy_{};
};

}  // namespace runnel::test
