#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace runnel::bench {

/// One writer, any number of readers, who repeat when a write came in between. By the book: H.-J.
/// Boehm, "Can seqlocks get along with programming language memory models?", 2012: the words are
/// relaxed atomics, so there is no data race.
template <typename T>
class Seqlock {
 public:
  static constexpr const char* kName = "seqlock";
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(std::uint64_t) == 0);

  void Write(const T& value) {
    const std::uint64_t version = version_.load(std::memory_order_relaxed);
    version_.store(version + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    const auto* from = reinterpret_cast<const unsigned char*>(&value);
    for (std::atomic<std::uint64_t>& word : words_) {
      std::uint64_t content;
      std::memcpy(&content, from, sizeof(content));
      word.store(content, std::memory_order_relaxed);
      from += sizeof(content);
    }
    version_.store(version + 2, std::memory_order_release);
  }
  void Read(T& value) const {
    while (!TryRead(value, version_.load(std::memory_order_acquire))) {
    }
  }
  /// Only a value that has not been taken yet; `value` may be torn if there is none. One reader.
  /// Looks at one word if there is none.
  bool Take(T& value) {
    const std::uint64_t version = version_.load(std::memory_order_acquire);
    if (version == taken_ || !TryRead(value, version)) return false;
    taken_ = version;
    return true;
  }

 private:
  static constexpr std::size_t kWords = sizeof(T) / sizeof(std::uint64_t);

  bool TryRead(T& value, std::uint64_t version) const {
    if (version % 2 != 0) return false;
    auto* to = reinterpret_cast<unsigned char*>(&value);
    for (const std::atomic<std::uint64_t>& word : words_) {
      const std::uint64_t content = word.load(std::memory_order_relaxed);
      std::memcpy(to, &content, sizeof(content));
      to += sizeof(content);
    }
    std::atomic_thread_fence(std::memory_order_acquire);
    return version_.load(std::memory_order_relaxed) == version;
  }

  alignas(64) std::atomic<std::uint64_t> version_{0};
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
  alignas(64) std::uint64_t taken_ = 0;  // the reader's own
};

}  // namespace runnel::bench
