// Searches the schedules and memory orders of queues that make and destroy values in place.

#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "core/lockfree/bounded_queue.h"
#include "core/lockfree/overwriting_queue.h"
#include "core/lockfree/stream_queue.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

/// What a side of the queue notes for itself: the search reports a second thread that touches it.
template <typename T>
class SearchedNote {
 public:
  SearchedNote(T value) { value_($) = value; }
  operator T() const { return value_($); }
  SearchedNote& operator=(T value) {
    value_($) = value;
    return *this;
  }

 private:
  mutable rl::var<T> value_;
};

/// Plain ground below values that are made and destroyed in place: a new value on it is a new one to
/// the search, which then does not see that the old one is still in use. One table for each run.
class Grounds {
 public:
  Grounds() { current = this; }
  static void Tread(const void* place) {
    for (Ground& ground : current->grounds_) {
      if (ground.place == nullptr) ground.place = place;
      if (ground.place != place) continue;
      ground.trodden($) = 1;
      return;
    }
    RL_ASSERT(!"too many places for the table");
  }

 private:
  struct Ground {
    const void* place = nullptr;
    rl::var<int> trodden;
  };
  static inline Grounds* current = nullptr;
  Ground grounds_[24];
};
class Grounded {
 public:
  Grounded() : Grounded(0) {}
  explicit Grounded(int value) noexcept {
    Grounds::Tread(this);
    plain_.Set(value);
  }
  Grounded(Grounded&& other) noexcept : Grounded(other.Get()) {}
  Grounded& operator=(Grounded&& other) noexcept {
    Set(other.Get());
    return *this;
  }
  ~Grounded() { Grounds::Tread(this); }
  [[nodiscard]] int Get() const {
    Grounds::Tread(this);
    return plain_.Get();
  }
  void Set(int value) {
    Grounds::Tread(this);
    plain_.Set(value);
  }

 private:
  SearchedPlain plain_;
};

using SearchedQueue = StreamQueue<Grounded, SearchedAtomic, SearchedNote>;

// Several laps of a short queue: what comes out is what went in, whole, once and in order, and no
// cell is touched by both sides at once. With room for one every value meets the full queue.
template <std::size_t kCapacity>
struct StreamSuite : rl::test_suite<StreamSuite<kCapacity>, 2> {
  Grounds grounds;
  SearchedQueue queue{kCapacity};

  void thread(unsigned index) {
    if (index == 0) {
      int next = 1;
      for (int attempt = 0; attempt < 6; ++attempt) {
        Grounded value(next);
        if (queue.TryPush(std::move(value))) ++next;
      }
      return;
    }
    int last = 0;
    for (int attempt = 0; attempt < 6; ++attempt) {
      Grounded value;
      if (!queue.TryPop(value)) continue;
      RL_ASSERT(value.Get() == last + 1);
      last = value.Get();
    }
  }
};

TEST(StreamQueueSearch, EachValueIsTakenOnceWholeAndInOrder) {
  EXPECT_TRUE(Search<StreamSuite<1>>(kIterations, 3));
  EXPECT_TRUE(Search<StreamSuite<2>>(kIterations, 2));
  EXPECT_TRUE(Search<StreamSuite<3>>(kIterations, 2));
}

// The reader works in the cell, which its writer must not touch before it is given back.
struct ReadingInPlaceSuite : rl::test_suite<ReadingInPlaceSuite, 2> {
  Grounds grounds;
  SearchedQueue queue{2};

  void thread(unsigned index) {
    if (index == 0) {
      for (int i = 1; i <= 5; ++i) (void)queue.TryPush(Grounded(i));
      return;
    }
    for (int attempt = 0; attempt < 5; ++attempt) {
      Grounded* const front = queue.Front();
      if (front == nullptr) continue;
      const int value = front->Get();
      RL_ASSERT(value >= 1 && value <= 5);
      front->Set(-value);
      RL_ASSERT(front->Get() == -value);
      queue.PopFront();
    }
  }
};

TEST(StreamQueueSearch, WriterLeavesTheFrontToTheReader) { EXPECT_TRUE(Search<ReadingInPlaceSuite>(kIterations, 3)); }

// Either side may pass to another thread, if that is ordered; a third one may ask for the size.
struct HandingOverSuite : rl::test_suite<HandingOverSuite, 4> {
  Grounds grounds;
  SearchedQueue queue{2};
  SearchedAtomic<int> second_may_write{0};

  void thread(unsigned index) {
    if (index == 0) {
      (void)queue.TryPush(Grounded(1));
      (void)queue.TryPush(Grounded(2));
      second_may_write.store(1, std::memory_order_release);
    } else if (index == 1) {
      if (second_may_write.load(std::memory_order_acquire) == 0) return;
      (void)queue.TryPush(Grounded(3));
    } else if (index == 2) {
      int last = 0;
      for (int attempt = 0; attempt < 4; ++attempt) {
        Grounded value;
        if (!queue.TryPop(value)) continue;
        RL_ASSERT(value.Get() == last + 1);
        last = value.Get();
      }
    } else {
      RL_ASSERT(queue.size() <= 3);
    }
  }
};

TEST(StreamQueueSearch, WritersMayTakeTurns) { EXPECT_TRUE(Search<HandingOverSuite>(kIterations, 2)); }

using SearchedOverwriting = OverwritingQueue<Grounded, SearchedAtomic, SearchedNote>;

// A writer that never waits, over several laps, and a reader that works in the cell: what comes out is what went
// in, whole, once and in order, and no cell is touched by both.
template <std::size_t kCapacity, int kValues>
struct OverwritingSuite : rl::test_suite<OverwritingSuite<kCapacity, kValues>, 2> {
  Grounds grounds;
  SearchedOverwriting queue{kCapacity};

  void thread(unsigned index) {
    if (index == 0) {
      for (int i = 1; i <= kValues; ++i) {
        if (queue.TryEmplace(i)) continue;
        // Full, or the reader is at the cell: then this one is left out.
        if (queue.size() == kCapacity) (void)queue.DropOldest();
        (void)queue.TryEmplace(i);
      }
      return;
    }
    int last = 0;
    for (int attempt = 0; attempt < 3; ++attempt) {
      Grounded* const front = queue.Front();
      if (front == nullptr) continue;
      RL_ASSERT(front == queue.Front());
      const int value = front->Get();
      RL_ASSERT(value > last);
      last = value;
      front->Set(-value);
      RL_ASSERT(front->Get() == -value);
      queue.PopFront();
    }
  }
};

TEST(OverwritingQueueSearch, ReaderKeepsWhatItHasClaimed) {
  EXPECT_TRUE((Search<OverwritingSuite<1, 4>>(kIterations / 10, 2)));
  EXPECT_TRUE((Search<OverwritingSuite<2, 6>>(kIterations / 10, 1)));
}

// Somebody else drops, too, as who exchanges a queue does.
struct DroppedFromOutsideSuite : rl::test_suite<DroppedFromOutsideSuite, 3> {
  Grounds grounds;
  SearchedOverwriting queue{1};

  void thread(unsigned index) {
    if (index == 0) {
      for (int i = 1; i <= 4; ++i) {
        if (queue.TryEmplace(i)) continue;
        if (queue.size() == 1) (void)queue.DropOldest();
        (void)queue.TryEmplace(i);
      }
    } else if (index == 1) {
      (void)queue.DropOldestFromOutside();
    } else {
      int last = 0;
      for (int attempt = 0; attempt < 2; ++attempt) {
        Grounded* const front = queue.Front();
        if (front == nullptr) continue;
        RL_ASSERT(front->Get() > last);
        last = front->Get();
        queue.PopFront();
      }
    }
  }
};

// Who drops from outside stands still, the reader takes what comes next, and the writer comes round to the cell.
struct ComeRoundSuite : rl::test_suite<ComeRoundSuite, 3> {
  Grounds grounds;
  SearchedOverwriting queue{2};

  void before() {
    RL_ASSERT(queue.TryEmplace(1));
    RL_ASSERT(queue.TryEmplace(2));
  }
  void thread(unsigned index) {
    if (index == 0) {
      (void)queue.DropOldestFromOutside();
    } else if (index == 1) {
      if (queue.Front() != nullptr) queue.PopFront();
    } else {
      for (int i = 3; i <= 5; ++i) {
        if (queue.TryEmplace(i)) continue;
        (void)queue.DropOldest();
        (void)queue.TryEmplace(i);
      }
    }
  }
};

TEST(OverwritingQueueSearch, WhatOthersDropIsTheirsUntilTheyAreDone) {
  EXPECT_TRUE(Search<ComeRoundSuite>(kIterations / 10, 1));
  EXPECT_TRUE(SearchAtRandom<DroppedFromOutsideSuite>(kIterations / 20));
}

// The queue for many, with a capacity that two laps need.
struct SharedQueueSuite : rl::test_suite<SharedQueueSuite, 4> {
  Grounds grounds;
  BoundedQueue<Grounded, SearchedAtomic> queue{1};
  SearchedAtomic<int> seen[5];

  void thread(unsigned index) {
    for (int i = 1; i <= 2; ++i) {
      if (index < 2) {
        (void)queue.TryPush(Grounded(static_cast<int>(2 * index) + i));
      } else {
        (void)queue.TryConsume([this](Grounded& oldest) {
          RL_ASSERT(oldest.Get() >= 1 && oldest.Get() <= 4);
          RL_ASSERT(seen[oldest.Get()].fetch_add(1, std::memory_order_relaxed) == 0);
        });
      }
    }
  }
};

TEST(BoundedQueueSearch, EachCellBelongsToOneAtATime) { EXPECT_TRUE(Search<SharedQueueSuite>(kIterations, 1)); }

}  // namespace
}  // namespace runnel::test
