#pragma once

#include <chrono>
#include <iostream>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
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
    if (is_terminal_) std::cout << "\r\x1b[K";
    const std::string pace = is_paused ? "paused" : "x" + NumberText(factor);
    const std::string line = fmt::format("{:8.2f} s  {:7}{}", ToSeconds(time), pace, text);
    std::cout << (is_terminal_ ? CutTo(line, TerminalWidth()) : line);
    if (!is_terminal_) std::cout << '\n';
    std::cout << std::flush;
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

  // Of stdout. A line that is as long would wrap on some.
  [[nodiscard]] static std::size_t TerminalWidth() {
    winsize size{};
    const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return is_known ? size.ws_col - 1U : std::string::npos;
  }
  // So many characters, where one may have several bytes.
  [[nodiscard]] static std::string CutTo(const std::string& line, std::size_t width) {
    std::size_t characters = 0;
    for (std::size_t at = 0; at < line.size(); ++at) {
      const bool begins = (static_cast<unsigned char>(line[at]) & 0xc0) != 0x80;
      if (begins && ++characters > width) return line.substr(0, at);
    }
    return line;
  }

  using WallTime = std::chrono::steady_clock::time_point;

  const bool is_on_;
  const bool is_terminal_;
  bool has_line_ = false;
  WallTime shown_at_;
  Duration shown_time_{};
  bool has_shown_pause_ = false;  // at shown_time_
};

}  // namespace runnel::program
