#pragma once

// Debian: libconcurrentqueue-dev. Without it the suite runs without this rival.
#if __has_include(<concurrentqueue/concurrentqueue.h>)
#define RUNNEL_BENCH_HAS_MOODYCAMEL 1

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <concurrentqueue/concurrentqueue.h>
#pragma GCC diagnostic pop

namespace runnel::bench {

/// moodycamel::ConcurrentQueue with tokens and without allocation, as its author advises. Any
/// number of producers and consumers.
template <typename T, std::size_t kCapacity = 1024>
class MoodycamelQueue {
 public:
  static constexpr const char* kName = "moodycamel";

  bool Push(const T& value) { return queue_.try_enqueue(producer_, value); }
  bool Take(T& value) { return queue_.try_dequeue_from_producer(producer_, value); }

  // As a cell of a ring: each value is taken before the next comes.
  void Write(const T& value) { (void)Push(value); }
  void Read(T& value) { (void)Take(value); }

 private:
  moodycamel::ConcurrentQueue<T> queue_{kCapacity};
  moodycamel::ProducerToken producer_{queue_};
};

}  // namespace runnel::bench
#endif
