#pragma once

#include <optional>
#include <type_traits>
#include <utility>

#include "core/base/check.h"
#include "core/channel/lease.h"
#include "core/lockfree/buffer_pool.h"

namespace runnel {

template <typename T>
class Channel;

/// Exclusive write access to one buffer, until it is published or dropped. What is in the buffer
/// first is what an earlier use left there: a vector keeps its capacity, and so filling it again
/// does not allocate.
///
/// Threads:  one at a time. Errors: writing through an empty loan throws ProgrammingError.
template <typename T>
class Loan {
 public:
  Loan() = default;
  Loan(Loan&& other) noexcept : slot_(std::exchange(other.slot_, Slot{})) {}
  Loan& operator=(Loan&& other) noexcept {
    if (this != &other) {
      Drop();
      slot_ = std::exchange(other.slot_, Slot{});
    }
    return *this;
  }
  [[gnu::always_inline]] ~Loan() { Drop(); }

  [[nodiscard]] bool has_value() const noexcept {
    if constexpr (kIsInlined<T>) {
      return slot_.has_value();
    } else {
      return slot_ != nullptr;
    }
  }
  explicit operator bool() const noexcept { return has_value(); }
  T& operator*() {
    RUNNEL_CHECK(has_value(), "the loan is empty: the pool had no free buffer");
    if constexpr (kIsInlined<T>) {
      return *slot_;
    } else {
      return slot_->value();
    }
  }
  T* operator->() { return &**this; }

 private:
  friend class Channel<T>;
  using Buffer = runnel::Buffer<T>;
  // An inlined value needs no buffer: its loan is the value itself.
  using Slot = std::conditional_t<kIsInlined<T>, std::optional<T>, Buffer*>;

  explicit Loan(Slot slot) noexcept : slot_(std::move(slot)) {}
  // What is seldom is not told where the loan lies, so that it can lie in a register.
  [[gnu::always_inline]] void Drop() noexcept {
    if constexpr (!kIsInlined<T>) {
      if (slot_ != nullptr) [[unlikely]]
        DropLoan(*slot_);
    }
    slot_ = Slot{};
  }
  [[gnu::noinline]] static void DropLoan(Buffer& buffer) noexcept requires(!kIsInlined<T>) { buffer.DropLoan(); }

  Slot slot_{};
};

}  // namespace runnel
