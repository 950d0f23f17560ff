#pragma once

#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

class CycleRunner;
class CycleTracer;

/// Keeps some threads between two of their cycles while it lives, so that what is changed meanwhile
/// takes effect as a whole. They sleep; cycles that fall due begin when it ends.
///
/// Threads:  one at a time; not within a cycle, and not under the structure lock, which a cycle might
///           be waiting for. What is done while it lives should be short.
class CycleHold {
 public:
  CycleHold() = default;
  ~CycleHold() { Release(); }
  CycleHold(CycleHold&&) = default;
  CycleHold& operator=(CycleHold&& other) noexcept {
    if (this != &other) {
      Release();
      runners_ = std::exchange(other.runners_, {});
      began_ = other.began_;
      tracer_ = other.tracer_;
    }
    return *this;
  }

  /// Waits until all `runners` have come to the end of a cycle, those whose cycles take long first, and those that take
  /// long now, though they usually do not: so each of the others is kept for two of its own cycles, or for a moment.
  /// Errors: one that has not after `timeout`, of the machine's clock; all go on then.
  /// `tracer`, if there is one, is told when it is over.
  static Result<CycleHold> Take(std::vector<std::shared_ptr<CycleRunner>> runners, Duration timeout,
                                CycleTracer* tracer = nullptr);
  /// Lets them go on.
  void Release() noexcept;

  /// When the first thread may have come to stand, by the machine's steady clock.
  [[nodiscard]] Time began() const noexcept { return began_; }

 private:
  void LetOthersGoOn(std::deque<std::shared_ptr<CycleRunner>>& left, Duration waited);

  std::vector<std::shared_ptr<CycleRunner>> runners_;
  Time began_{};
  CycleTracer* tracer_ = nullptr;
  int patience_ = 2;  // of those that are kept, in cycles of their own
};

}  // namespace runnel
