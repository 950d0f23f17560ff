#pragma once

#include <chrono>
#include <iostream>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/clock.h"

namespace runnel::program {

/// Three digits, or all those before the point: "0.05", "9.81", "1300"; no exponent for what is
/// large.
[[nodiscard]] inline std::string NumberText(double number) {
  return number < 100 ? fmt::format("{:.3g}", number) : fmt::format("{:.0f}", number);
}

/// Shows on stdout how a run is going: on a terminal one line that is written anew about five times
/// a second, else one line a second.
class ProgressDisplay {
 public:
  /// `is_on` false: shows nothing.
  explicit ProgressDisplay(bool is_on)
      : is_on_(is_on), is_terminal_(isatty(STDOUT_FILENO) != 0), shown_at_(std::chrono::steady_clock::now()) {}
  ~ProgressDisplay() { Clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Whether it is time for another Show(). Looks at the machine's clock.
  [[nodiscard]] bool IsDue() const {
    const auto since = std::chrono::steady_clock::now() - shown_at_;
    return is_on_ && since >= (is_terminal_ ? Duration(kOnTerminal) : Duration(kElsewhere));
  }
  /// `time` is how long the application has been running, on its own clock. Where lines are written
  /// one below the other, a pause is one line.
  void Show(Duration time, bool is_paused, const std::string& text) {
    const auto now = std::chrono::steady_clock::now();
    const double factor = ToSeconds(time - shown_time_) / ToSeconds(Duration(now - shown_at_));
    shown_at_ = now;
    const bool stands_still = time == std::exchange(shown_time_, time) && is_paused;
    if (std::exchange(has_shown_pause_, is_paused) && stands_still && !is_terminal_) return;
    const std::string pace = is_paused ? "paused" : "x" + NumberText(factor);
    const std::string line = fmt::format("{:8.2f} s  {:7}{}", ToSeconds(time), pace, text);
    // The terminal cuts off what is too long for it, rather than begin another line.
    std::cout << (is_terminal_ ? "\r\x1b[K\x1b[?7l" + line + "\x1b[?7h" : line + '\n') << std::flush;
    has_line_ = is_terminal_;
  }
  /// Makes room for other output.
  void Clear() {
    if (has_line_) std::cout << "\r\x1b[K" << std::flush;
    has_line_ = false;
  }

 private:
  static constexpr auto kOnTerminal = std::chrono::milliseconds(200);
  static constexpr auto kElsewhere = std::chrono::seconds(1);

  using WallTime = std::chrono::steady_clock::time_point;

  const bool is_on_;
  const bool is_terminal_;
  bool has_line_ = false;
  WallTime shown_at_;
  Duration shown_time_{};
  bool has_shown_pause_ = false;  // at shown_time_
};

}  // namespace runnel::program
