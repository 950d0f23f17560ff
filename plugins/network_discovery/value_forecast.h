#pragma once

#include <optional>

#include "core/base/clock.h"

namespace runnel {

/// When the next value of a port is likely to come, as far as those before came at even intervals: so that who sends
/// it is awake by then. A thread that sleeps takes longer to wake than all the rest of what it does for a small value.
///
/// Threads: one. Allocation: none.
class ValueForecast {
 public:
  /// While somebody looks for the value, awake.
  struct Window {
    Time begin;
    Time end;
  };

  /// A value has come.
  void Note(Time came);
  /// Nothing if values come as they like, too often, or have ceased to come: then nobody is awake for nothing.
  [[nodiscard]] std::optional<Window> window(Time now) const;

 private:
  void BeginAnew(Time came);

  Time last_{};           // as it came
  Time expected_{};       // the next
  Duration interval_{};   // mean
  Duration deviation_{};  // mean, of what comes from what was expected
  int even_ = 0;          // so many in a row
};

}  // namespace runnel
