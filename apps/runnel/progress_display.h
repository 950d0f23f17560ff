#pragma once

#include <chrono>
#include <string>

#include "core/base/clock.h"

namespace runnel::program {

/// Three digits, or all those before the point: "0.05", "9.81", "1300"; no exponent for what is
/// large.
[[nodiscard]] std::string NumberText(double number);

/// Shows on stdout how a run is going: on a terminal one line that is written anew about five times
/// a second, else one line a second.
class ProgressDisplay {
 public:
  /// `is_on` false: shows nothing.
  explicit ProgressDisplay(bool is_on);
  ~ProgressDisplay() { Clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Whether it is time for another Show(). Looks at the machine's clock.
  [[nodiscard]] bool IsDue() const;
  /// `time` is how long the application has been running, on its own clock. Where lines are written
  /// one below the other, a pause is one line.
  void Show(Duration time, bool is_paused, const std::string& text);
  /// Makes room for other output.
  void Clear();

 private:
  using WallTime = std::chrono::steady_clock::time_point;

  const bool is_on_;
  const bool is_terminal_;
  bool has_line_ = false;
  WallTime shown_at_;
  Duration shown_time_{};
  bool has_shown_pause_ = false;  // at shown_time_
};

}  // namespace runnel::program
