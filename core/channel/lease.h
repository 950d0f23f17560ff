#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "core/base/check.h"
#include "core/base/clock.h"
#include "core/channel/channel_options.h"
#include "core/channel/value_times.h"
#include "core/lockfree/latest_buffer.h"
#include "core/lockfree/latest_value.h"

namespace runnel {

/// Whether values of T travel inlined, as copies of their words, or in buffers of a pool, which
/// readers hold instead of copying. A few words are copied sooner than a buffer is held. Specialise
/// it to false for a type that shall always travel in buffers.
template <typename T>
inline constexpr bool kIsInlined = std::is_trivially_copyable_v<T>&& std::is_copy_constructible_v<T> && sizeof(T) <= 32;

/// Whether values of T that travel in buffers lie in queues as copies nevertheless: a short copy
/// costs the taker less than the publisher's buffer, which it would share with the publisher.
template <typename T>
inline constexpr bool kIsCopiedInQueues = std::is_trivially_copyable_v<T>&& std::is_copy_constructible_v<T> &&
                                          sizeof(T) <= 256;

template <typename T>
class Channel;
template <typename T>
class Input;

namespace internal {

/// A value that travels inlined, copied.
template <typename T>
class InlinedValue {
 public:
  InlinedValue() = default;
  /// The newest one, or none.
  [[gnu::always_inline]] explicit InlinedValue(const LatestValue<T>& latest) noexcept {
    latest.Read(writable(), publication_);
  }
  InlinedValue(const T& value, const Publication& publication) noexcept : publication_(publication) {
    new (bytes_.data()) T(value);
  }

  [[nodiscard]] bool has_value() const noexcept { return publication_.sequence != 0; }
  [[nodiscard]] const T& value() const noexcept { return *std::launder(reinterpret_cast<const T*>(bytes_.data())); }
  [[nodiscard]] const Publication& publication() const noexcept { return publication_; }

 private:
  [[nodiscard]] T& writable() noexcept { return *std::launder(reinterpret_cast<T*>(bytes_.data())); }

  alignas(T) std::array<std::byte, sizeof(T)> bytes_;  // read only if has_value()
  Publication publication_;
};

/// Where readers find the value. Types that are copied where that is cheaper are copied also instead of being
/// forwarded, and so lie in the buffer itself: one need not ask the buffer.
template <typename T>
[[nodiscard, gnu::always_inline]] inline const T& ValueOf(const Buffer<T>& buffer) noexcept {
  if constexpr (kIsCopiedInQueues<T>) {
    return buffer.value();
  } else {
    return buffer.published_value();
  }
}

/// A value in a buffer, leased.
template <typename T>
class LeasedValue {
 public:
  LeasedValue() = default;
  explicit LeasedValue(BufferLease<T> lease) noexcept : lease_(std::move(lease)) {}
  /// The newest one, or none.
  LeasedValue(const LeasedValue&) = default;
  LeasedValue(LeasedValue&&) noexcept = default;
  LeasedValue& operator=(const LeasedValue&) = default;
  LeasedValue& operator=(LeasedValue&&) noexcept = default;
  [[gnu::always_inline]] ~LeasedValue() {}
  [[gnu::always_inline]] LeasedValue(LatestBuffer<T>& latest, HazardRecord<>& record) noexcept
      : lease_(latest.Lease(record)) {}

  [[nodiscard]] bool has_value() const noexcept { return lease_.get() != nullptr; }
  [[nodiscard]] const T& value() const noexcept { return ValueOf(*lease_.get()); }
  [[nodiscard]] const Publication& publication() const noexcept { return lease_.get()->publication; }
  [[nodiscard]] Buffer<T>* buffer() const noexcept { return lease_.get(); }

 private:
  BufferLease<T> lease_;
};

/// What the slot of an output has is never a copy.
struct NoCopy {};

/// A value in a buffer, leased, or a copy of one: what a queue gives away is a copy.
///
/// It says where the value is by a pointer, so that a value that is leased needs no memory for
/// this, but lies in registers.
template <typename T>
class LeasedOrCopiedValue {
 public:
  LeasedOrCopiedValue() noexcept {}
  /// A copy.
  LeasedOrCopiedValue(const T& value, const Publication& publication) noexcept
      : value_(Copy(value)), publication_(publication) {}
  /// The newest one, or none.
  [[gnu::always_inline]] LeasedOrCopiedValue(LatestBuffer<T>& latest, HazardRecord<>& record) noexcept
      : leased_(latest, record), value_(leased_.has_value() ? &leased_.value() : nullptr) {}
  /// The same as `other`, which is no copy.
  [[gnu::always_inline]] LeasedOrCopiedValue(LeasedOrCopiedValue&& other, NoCopy) noexcept
      : leased_(std::move(other.leased_)), value_(std::exchange(other.value_, nullptr)) {}
  LeasedOrCopiedValue(const LeasedOrCopiedValue& other) noexcept
      : leased_(other.leased_),
        value_(other.is_copy() ? Copy(*other.value_) : other.value_),
        publication_(other.publication_) {}
  LeasedOrCopiedValue(LeasedOrCopiedValue&& other) noexcept
      : leased_(std::move(other.leased_)),
        value_(leased_.has_value() || !other.has_value() ? other.value_ : Copy(*other.value_)),
        publication_(other.publication_) {
    other.value_ = nullptr;
  }
  LeasedOrCopiedValue& operator=(const LeasedOrCopiedValue& other) noexcept {
    return *this = LeasedOrCopiedValue(other);
  }
  LeasedOrCopiedValue& operator=(LeasedOrCopiedValue&& other) noexcept {
    if (this == &other) return *this;
    const bool is_copy = other.is_copy();
    leased_ = std::move(other.leased_);
    value_ = is_copy ? Copy(*other.value_) : other.value_;
    publication_ = other.publication_;
    other.value_ = nullptr;
    return *this;
  }
  [[gnu::always_inline]] ~LeasedOrCopiedValue() {}

  [[nodiscard]] bool has_value() const noexcept { return value_ != nullptr; }
  [[nodiscard]] const T& value() const noexcept { return *value_; }
  // By value, so that nobody asks where it lies.
  [[nodiscard, gnu::always_inline]] Publication publication() const noexcept {
    return leased_.has_value() ? leased_.publication() : publication_;
  }

 private:
  [[nodiscard]] bool is_copy() const noexcept { return has_value() && !leased_.has_value(); }
  const T* Copy(const T& value) noexcept { return std::construct_at(reinterpret_cast<T*>(bytes_), value); }

  LeasedValue<T> leased_;
  const T* value_ = nullptr;               // in the buffer, or the copy
  Publication publication_;                // of the copy, if it is one
  alignas(T) std::byte bytes_[sizeof(T)];  // read only then
};

template <typename T>
using HeldValue = std::conditional_t<kIsInlined<T>, InlinedValue<T>,
                                     std::conditional_t<kIsCopiedInQueues<T>, LeasedOrCopiedValue<T>, LeasedValue<T>>>;

}  // namespace internal

/// Read access to one published value. The value does not change while the lease is held, and lives
/// as long as the lease, whatever becomes of the port, the module and the connection meanwhile.
///
///     if (const auto pose = pose_input.Read()) Use(*pose, pose.timestamp());
///
/// Ownership:   of one reference to the value's buffer (none of an inlined value: a copy).
/// Threads:     one lease belongs to one thread at a time; copies are independent.
/// Allocation:  none.
/// Errors:      looking at an empty lease throws ProgrammingError.
template <typename T>
class Lease {
 public:
  Lease() = default;
  Lease(const Lease&) = default;
  Lease(Lease&&) noexcept = default;
  Lease& operator=(const Lease&) = default;
  Lease& operator=(Lease&&) noexcept = default;
  [[gnu::always_inline]] ~Lease() {}

  [[nodiscard]] bool has_value() const noexcept { return held_.has_value(); }
  explicit operator bool() const noexcept { return has_value(); }
  const T& operator*() const { return Checked().value(); }
  const T* operator->() const { return &Checked().value(); }
  [[nodiscard]] T value_or(T otherwise) const { return has_value() ? held_.value() : otherwise; }

  [[nodiscard]] Freshness freshness() const noexcept {
    if (!has_value()) return Freshness::kNoData;
    return held_.publication().sequence != last_ ? Freshness::kNew : Freshness::kOld;
  }
  [[nodiscard]] bool is_new() const noexcept { return freshness() == Freshness::kNew; }
  /// When the value was measured, if its publisher said so; else when it was published.
  [[nodiscard]] Time timestamp() const { return Time(Duration(Checked().publication().timestamp)); }
  /// The time of the cycle that published the value.
  [[nodiscard]] Time publication_time() const { return Time(Duration(Checked().publication().publication_time)); }
  [[nodiscard]] ValueTimes times() const { return ValueTimes::Of(Checked().publication()); }
  /// 1 for the first value that the source has published, and so on.
  [[nodiscard]] std::uint64_t sequence() const { return Checked().publication().sequence; }
  /// How many values of the same source came and went unseen since the last read of this input.
  [[nodiscard]] std::uint64_t missed() const noexcept {
    const std::uint64_t sequence = has_value() ? held_.publication().sequence : 0;
    return last_ == 0 || sequence <= last_ ? 0 : sequence - last_ - 1;
  }

 private:
  friend class Channel<T>;
  friend class Input<T>;
  // The channel's newest value, made in place, so that it is copied once or not at all; `reader`
  // notes its number and says which it had before.
  template <typename Reader>
  [[gnu::always_inline]] Lease(Channel<T>& channel, HazardRecord<>& record, Reader& reader) noexcept
      : held_(channel.Read(record)) {
    if (has_value()) [[likely]]
      last_ = reader.Note(held_.publication().sequence);
  }
  // The same as one that came by the slow path. Made anew, so that it may lie in registers even if
  // the other had to lie in memory.
  [[gnu::always_inline]] Lease(Lease&& other, internal::NoCopy no_copy) noexcept
      : held_(FromSlot(std::move(other.held_), no_copy)), last_(other.last_) {}
  [[gnu::always_inline]] static internal::HeldValue<T> FromSlot(internal::HeldValue<T>&& held,
                                                                internal::NoCopy no_copy) {
    if constexpr (std::is_same_v<internal::HeldValue<T>, internal::LeasedOrCopiedValue<T>>) {
      return internal::HeldValue<T>(std::move(held), no_copy);
    } else {
      return std::move(held);
    }
  }

  const internal::HeldValue<T>& Checked() const {
    RUNNEL_CHECK(has_value(), "the lease is empty: no data has come yet");
    return held_;
  }

  internal::HeldValue<T> held_;
  // Of the same source, what the reader had before; 0: nothing. Mutable only because GCC keeps what
  // is declared const in memory, unless a part of it is mutable: "const auto read = …" then lies
  // in registers.
  mutable std::uint64_t last_ = 0;
};

}  // namespace runnel
