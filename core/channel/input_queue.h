#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "core/channel/input_queue_base.h"
#include "core/channel/queued_value.h"
#include "core/lockfree/bounded_queue.h"
#include "core/lockfree/overwriting_queue.h"
#include "core/lockfree/publication.h"
#include "core/lockfree/stream_queue.h"

namespace runnel {

/// The values that wait at one input, from all its sources, in the order of their coming.
///
/// Threads:     Push() by any publisher, or by that of the one source; Pop() by one reader at a
///              time; PutFirst() at most once for each source, by who connects it.
/// Progress:    lock-free; with one writer and nothing to push out, wait-free. A publisher never
///              waits for a reader that has been stopped.
/// Allocation:  in the constructor only.
/// @tparam Queued  what lies in it, see queued_value.h.
template <typename Queued>
class InputQueue final : public InputQueueBase {
  using Content = typename Queued::Content;
  using Stream = StreamQueue<Queued>;
  using Overwriting = OverwritingQueue<Queued>;
  using Shared = BoundedQueue<Queued>;

 public:
  [[gnu::noinline]] InputQueue(std::size_t capacity, OnFull on_full, Writers writers)
      : InputQueueBase(capacity, on_full, writers) {
    if (writers == Writers::kSeveral) {
      shared_ = std::make_unique<Shared>(capacity);
    } else if (on_full == OnFull::kDropOldest) {
      overwriting_ = std::make_unique<Overwriting>(capacity);
    } else {
      stream_ = std::make_unique<Stream>(capacity);
    }
  }

  /// Returns false if the queue was full and refuses.
  [[gnu::always_inline]] bool Push(Content content, const Publication& publication, std::uint64_t source) noexcept {
    if (IsCrowdedOut()) [[unlikely]]
      return Drop();
    if (overwriting_ != nullptr && overwriting_->TryEmplace(std::move(content), publication, source)) return true;
    if (stream_ == nullptr) return PushMakingRoom(std::move(content), publication, source);
    return stream_->TryEmplace(std::move(content), publication, source) || Drop();
  }

  /// Puts in the value that a new connection delivers, while its source may be publishing already:
  /// call it after the source has been told of the queue, with the source's newest value then. It
  /// comes out before later ones, unless values up to it have come in through Push().
  void PutFirst(Content content, const Publication& publication, std::uint64_t source) noexcept {
    if (shared_ != nullptr) {
      (void)Push(std::move(content), publication, source);
      return;
    }
    first_.emplace(std::move(content), publication, source);
    // release: pairs with the acquire in PopAlone(). What the source had pushed before it published
    // this value is in the queue for whoever sees the flag.
    first_waits_.store(true, std::memory_order_release);
  }

  /// Calls `use(queued)` for the oldest value, then destroys that; false if there is none.
  template <typename Use>
  [[nodiscard]] bool Pop(Use&& use) noexcept {
    return PopIf([] { return true; }, std::forward<Use>(use));
  }
  /// The same, but asks `may()` when a value has been seen, and leaves it there if not. What the
  /// value's publisher had pushed before it, into whatever queue, is visible to `may`.
  template <typename May, typename Use>
  [[nodiscard]] bool PopIf(May&& may, Use&& use) noexcept {
    if (overwriting_ != nullptr) return PopAlone(*overwriting_, may, use);
    if (stream_ != nullptr) return PopAlone(*stream_, may, use);
    return shared_->TryConsumeIf(may, use);
  }

  [[nodiscard]] bool HasNext() const noexcept override {
    if (shared_ != nullptr) return shared_->HasOldest();
    if (first_waits_.load(std::memory_order_acquire)) return true;
    return overwriting_ != nullptr ? overwriting_->HasNext() : stream_->Front() != nullptr;
  }

  [[nodiscard]] bool WouldRefuse() noexcept override {
    if (on_full_ != OnFull::kRefuse) return false;
    if (IsCrowdedOut()) return true;
    return stream_ != nullptr ? !stream_->HasCapacity() : shared_->size() >= capacity_;
  }
  [[nodiscard]] std::size_t size() const noexcept override {
    const std::size_t first = first_waits_.load(std::memory_order_relaxed) ? 1 : 0;
    if (overwriting_ != nullptr) return first + overwriting_->size() + overwriting_->claimed();
    return first + (stream_ != nullptr ? stream_->size() : shared_->size());
  }
  bool DropOldest() noexcept override {
    if (on_full_ != OnFull::kDropOldest) return false;
    const bool dropped =
        overwriting_ != nullptr ? overwriting_->DropOldestFromOutside() : shared_->TryConsume([](Queued&) {});
    if (dropped) CountDropped();
    return dropped;
  }

 private:
  static constexpr int kAttempts = 16;
  // In a register, if it can be.
  using Passed = std::conditional_t<std::is_trivially_copyable_v<Content>, Content, Content&&>;
  // Ends after a few attempts in any case: if a reader was stopped while it emptied the very cell
  // that is needed, the new value is dropped, whatever the policy. The publication by value: its publisher
  // has it in registers, and leaves it there as long as nobody asks where it lies.
  [[gnu::noinline]] bool PushMakingRoom(Passed content, Publication publication, std::uint64_t source) noexcept {
    if (overwriting_ == nullptr) return PushMakingRoomIn(*shared_, std::move(content), publication, source);
    return PushMakingRoomIn(*overwriting_, std::move(content), publication, source);
  }
  template <typename Queue>
  bool PushMakingRoomIn(Queue& queue, Passed content, const Publication& publication, std::uint64_t source) noexcept {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (queue.TryEmplace(std::move(content), publication, source)) return true;
      if (on_full_ != OnFull::kDropOldest) break;
      // Not full and yet no capacity: a reader is at work there, and dropping others would not help.
      if (queue.size() < queue.capacity()) continue;
      if (DropOldestOf(queue)) CountDropped();
    }
    return Drop();
  }
  static bool DropOldestOf(Overwriting& queue) noexcept { return queue.DropOldest(); }
  static bool DropOldestOf(Shared& queue) noexcept {
    return queue.TryConsume([](Queued&) {});
  }
  // From a queue of one writer. What Front() gives stays for the next time if it is not taken.
  template <typename Queue, typename May, typename Use>
  bool PopAlone(Queue& queue, May&& may, Use&& use) noexcept {
    // acquire: pairs with the release in PutFirst().
    if (first_waits_.load(std::memory_order_acquire)) [[unlikely]] {
      if (!may()) return false;
      // relaxed: for size(), and for this reader.
      first_waits_.store(false, std::memory_order_relaxed);
      std::optional<Queued> first = std::move(first_);
      first_.reset();
      const Queued* const front = queue.Front();
      // Else it comes through the queue, after those before it.
      if (front == nullptr || front->sequence() > first->sequence()) {
        use(*first);
        return true;
      }
    }
    Queued* const front = queue.Front();
    if (front == nullptr || !may()) return false;
    use(*front);
    queue.PopFront();
    return true;
  }

  std::unique_ptr<Stream> stream_;  // one of the three, constant from the constructor on
  std::unique_ptr<Overwriting> overwriting_;
  std::unique_ptr<Shared> shared_;
  std::atomic<bool> first_waits_{false};
  std::optional<Queued> first_;  // the connecting thread's, then the reader's
};

}  // namespace runnel
