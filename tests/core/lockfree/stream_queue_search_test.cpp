// Searches the schedules and memory orders of the queue between one writer and one reader.

#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

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

using SearchedQueue = StreamQueue<SearchedPlain, SearchedAtomic, SearchedNote>;

// Several laps of a short queue: what comes out is what went in, whole, once and in order, and no
// cell is touched by both sides at once. With room for one every value meets the full queue.
template <std::size_t kCapacity>
struct StreamSuite : rl::test_suite<StreamSuite<kCapacity>, 2> {
  SearchedQueue queue{kCapacity};

  void thread(unsigned index) {
    if (index == 0) {
      int next = 1;
      for (int attempt = 0; attempt < 6; ++attempt) {
        SearchedPlain value(next);
        if (queue.TryPush(std::move(value))) ++next;
      }
      return;
    }
    int last = 0;
    for (int attempt = 0; attempt < 6; ++attempt) {
      SearchedPlain value;
      if (!queue.TryPop(value)) continue;
      RL_ASSERT(value.Get() == last + 1);
      last = value.Get();
    }
  }
};

TEST(StreamQueueSearch, EachValueIsTakenOnceWholeAndInOrder) {
  EXPECT_TRUE(Search<StreamSuite<1>>(kIterations));
  EXPECT_TRUE(Search<StreamSuite<2>>(kIterations));
  EXPECT_TRUE(Search<StreamSuite<3>>(kIterations));
}

// The reader works in the cell, which its writer must not touch before it is given back.
struct ReadingInPlaceSuite : rl::test_suite<ReadingInPlaceSuite, 2> {
  SearchedQueue queue{2};

  void thread(unsigned index) {
    if (index == 0) {
      for (int i = 1; i <= 5; ++i) (void)queue.TryPush(SearchedPlain(i));
      return;
    }
    for (int attempt = 0; attempt < 5; ++attempt) {
      SearchedPlain* const front = queue.Front();
      if (front == nullptr) continue;
      const int value = front->Get();
      RL_ASSERT(value >= 1 && value <= 5);
      front->Set(-value);
      RL_ASSERT(front->Get() == -value);
      queue.PopFront();
    }
  }
};

TEST(StreamQueueSearch, WriterLeavesTheFrontToTheReader) {
  EXPECT_TRUE(Search<ReadingInPlaceSuite>(kIterations));
}

// Either side may pass to another thread, if that is ordered; a third one may ask for the size.
struct HandingOverSuite : rl::test_suite<HandingOverSuite, 4> {
  SearchedQueue queue{2};
  SearchedAtomic<int> second_may_write{0};

  void thread(unsigned index) {
    if (index == 0) {
      (void)queue.TryPush(SearchedPlain(1));
      (void)queue.TryPush(SearchedPlain(2));
      second_may_write.store(1, std::memory_order_release);
    } else if (index == 1) {
      if (second_may_write.load(std::memory_order_acquire) == 0) return;
      (void)queue.TryPush(SearchedPlain(3));
    } else if (index == 2) {
      int last = 0;
      for (int attempt = 0; attempt < 4; ++attempt) {
        SearchedPlain value;
        if (!queue.TryPop(value)) continue;
        RL_ASSERT(value.Get() == last + 1);
        last = value.Get();
      }
    } else {
      RL_ASSERT(queue.size() <= 3);
    }
  }
};

TEST(StreamQueueSearch, WritersMayTakeTurns) { EXPECT_TRUE(Search<HandingOverSuite>(kIterations)); }

}  // namespace
}  // namespace runnel::test
