#pragma once

#include <boost/lockfree/queue.hpp>
#include <boost/lockfree/spsc_queue.hpp>

namespace runnel::bench {

/// boost::lockfree::spsc_queue, its capacity known to the compiler. One producer, one consumer.
template <typename T, std::size_t kCapacity = 1024>
class BoostSpscQueue {
 public:
  static constexpr const char* kName = "boost spsc_queue";

  bool Push(const T& value) { return queue_.push(value); }
  bool Take(T& value) { return queue_.pop(value); }
  template <typename Use>
  std::size_t Drain(Use&& use) {
    return queue_.consume_all(use);
  }

  // As a cell of a ring: each value is taken before the next comes.
  void Write(const T& value) { (void)queue_.push(value); }
  void Read(T& value) { (void)queue_.pop(value); }

 private:
  boost::lockfree::spsc_queue<T, boost::lockfree::capacity<kCapacity>> queue_;
};

/// boost::lockfree::queue of fixed size. Any number of producers and consumers.
template <typename T, std::size_t kCapacity = 1024>
class BoostQueue {
 public:
  static constexpr const char* kName = "boost queue";

  bool Push(const T& value) { return queue_.bounded_push(value); }
  bool Take(T& value) { return queue_.pop(value); }

 private:
  boost::lockfree::queue<T, boost::lockfree::capacity<kCapacity>> queue_;
};

}  // namespace runnel::bench
