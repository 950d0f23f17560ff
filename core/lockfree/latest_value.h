#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/lockfree/cache_line.h"
#include "core/lockfree/publication.h"

namespace runnel {

/// The newest value of a small, trivially copyable type: how ports pass inlined values on.
///
/// Four cells are written in turn, so that a reader never waits for a writer: it copies the newest
/// complete cell, and starts again only if the writer came round to that very cell meanwhile.
///
/// Threads:     one thread at a time may Publish(); any number may Read() at any time.
/// Progress:    Publish() is wait-free and writes to no line that readers write; Read() is
///              lock-free: it repeats only if at least three publications have happened meanwhile.
/// Allocation:  none.
/// No data race: every shared word is an atomic; see README.md for the pairing of the orders.
/// @tparam Atomic  replaced in tests. @tparam kCells  fewer in tests, so that a lap is soon run.
template <typename T, template <typename> class Atomic = std::atomic, std::size_t kCells = 4>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>,
                "LatestValue copies words: T must be trivially copyable; use LatestBuffer instead");

 public:
  void Publish(const T& value, std::int64_t timestamp, std::int64_t publication_time, std::uint64_t order) noexcept {
    Write(value, timestamp, publication_time,
          [order](Cell& cell) { cell.order.store(order, std::memory_order_release); });
  }
  /// The same without an order, as all before: whoever has given one always gives one.
  void Publish(const T& value, std::int64_t timestamp, std::int64_t publication_time) noexcept {
    Write(value, timestamp, publication_time, [](Cell&) {});
  }
  void Publish(const T& value, std::int64_t now) noexcept { Publish(value, now, now); }

  /// Copies the newest value to `value`. Returns false before the first publication.
  bool Read(T& value, Publication& publication) const noexcept {
    return Copy(value, [&](const Cell& cell, std::uint64_t sequence) {
      publication.timestamp = cell.timestamp.load(std::memory_order_acquire);
      publication.publication_time = cell.publication_time.load(std::memory_order_acquire);
      publication.order = cell.order.load(std::memory_order_acquire);
      publication.sequence = sequence;
    });
  }
  /// The same without what is known about the value.
  bool Read(T& value) const noexcept {
    return Copy(value, [](const Cell&, std::uint64_t) {});
  }

  /// The number of publications so far; what Read() would return, at least. Any thread.
  [[nodiscard]] std::uint64_t sequence() const noexcept {
    // relaxed: a count; who reads the value looks again.
    return newest_.load(std::memory_order_relaxed);
  }

 private:
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
  static constexpr std::uint64_t kBeingWritten = ~std::uint64_t{0};  // never the newest

  // One line, with a value of 32 bytes.
  struct alignas(kCacheLineSize) Cell {
    Atomic<std::uint64_t> sequence{kBeingWritten};
    Atomic<std::int64_t> timestamp{0};
    Atomic<std::int64_t> publication_time{0};
    Atomic<std::uint64_t> order{0};
    std::array<Atomic<std::uint64_t>, kWords> words{};
  };

  // Word by word: who has just written the members would wait for a load that is wider than its stores.
  [[gnu::always_inline]] static std::uint64_t Word(const T& value, std::size_t i) noexcept {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&value) + i * 8;
    std::uint64_t word = 0;
    if (sizeof(T) % 8 == 0 || i + 1 < kWords) {
      std::memcpy(&word, bytes, 8);
    } else {
      std::memcpy(&word, bytes, sizeof(T) % 8);
    }
    return word;
  }
  // `also(cell)` stores what else there is, with release.
  template <typename Also>
  [[gnu::always_inline]] void Write(const T& value, std::int64_t timestamp, std::int64_t publication_time,
                                    Also&& also) noexcept {
    const std::uint64_t sequence = ++published_;
    Cell& cell = cells_[sequence % kCells];
    // relaxed: the release stores of the words below carry it to whoever sees one of them.
    cell.sequence.store(kBeingWritten, std::memory_order_relaxed);
    // release: pairs with the acquire loads of the words in Read(). A reader that sees one of these
    // words also sees kBeingWritten, or something later, in the check that ends its copy.
    for (std::size_t i = 0; i < kWords; ++i) {
      cell.words[i].store(Word(value, i), std::memory_order_release);
    }
    cell.timestamp.store(timestamp, std::memory_order_release);
    cell.publication_time.store(publication_time, std::memory_order_release);
    also(cell);
    // relaxed: the release store below carries it.
    cell.sequence.store(sequence, std::memory_order_relaxed);
    // release: pairs with the acquire in Read(): the whole cell is visible with its number.
    newest_.store(sequence, std::memory_order_release);
  }
  // `also(cell, sequence)` copies what else is wanted of the cell, with acquire.
  template <typename Also>
  [[gnu::always_inline]] bool Copy(T& value, Also&& also) const noexcept {
    for (;;) {
      // acquire: pairs with the last store in Publish().
      const std::uint64_t sequence = newest_.load(std::memory_order_acquire);
      const Cell& cell = cells_[sequence % kCells];
      std::array<std::uint64_t, kWords> words;
      // acquire: keeps the check below from moving up, and makes it see at least the state that a
      // writer of one of these words had set before.
      for (std::size_t i = 0; i < kWords; ++i) {
        words[i] = cell.words[i].load(std::memory_order_acquire);
      }
      also(cell, sequence);
      // relaxed: the acquire loads above order it.
      if (cell.sequence.load(std::memory_order_relaxed) != sequence) [[unlikely]] {
        if (sequence == 0) return false;  // nor has any cell a number as long as there is none
        continue;
      }
      std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
      return true;
    }
  }

  std::array<Cell, kCells> cells_;
  alignas(kCacheLineSize) Atomic<std::uint64_t> newest_{0};
  std::uint64_t published_ = 0;  // the writer's own
};

}  // namespace runnel
