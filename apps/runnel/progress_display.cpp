#include "apps/runnel/progress_display.h"

#include <iostream>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace runnel::program {

namespace {

constexpr auto kOnTerminal = std::chrono::milliseconds(200);
constexpr auto kElsewhere = std::chrono::seconds(1);

// Of stdout. A line that is as long would wrap on some.
std::size_t TerminalWidth() {
  winsize size{};
  const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return is_known ? size.ws_col - 1U : std::string::npos;
}

// So many characters, where one may have several bytes.
std::string CutTo(const std::string& line, std::size_t width) {
  std::size_t characters = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const bool begins = (static_cast<unsigned char>(line[at]) & 0xc0) != 0x80;
    if (begins && ++characters > width) return line.substr(0, at);
  }
  return line;
}

}  // namespace

std::string NumberText(double number) {
  return number < 100 ? fmt::format("{:.3g}", number) : fmt::format("{:.0f}", number);
}

ProgressDisplay::ProgressDisplay(bool is_on)
    : is_on_(is_on), is_terminal_(isatty(STDOUT_FILENO) != 0), shown_at_(std::chrono::steady_clock::now()) {}

bool ProgressDisplay::IsDue() const {
  const auto since = std::chrono::steady_clock::now() - shown_at_;
  return is_on_ && since >= (is_terminal_ ? Duration(kOnTerminal) : Duration(kElsewhere));
}

void ProgressDisplay::Show(Duration time, bool is_paused, const std::string& text) {
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

void ProgressDisplay::Clear() {
  if (has_line_) std::cout << "\r\x1b[K" << std::flush;
  has_line_ = false;
}

}  // namespace runnel::program
