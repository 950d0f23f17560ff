#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

namespace runnel::arena {

/// "[#####-----]  50 %  30 of 60  0:21 left".
[[nodiscard]] inline std::string ProgressLine(std::size_t done, std::size_t count, double elapsed) {
  constexpr std::size_t kBar = 30;
  const std::size_t filled = count == 0 ? kBar : kBar * done / count;
  const std::size_t percent = count == 0 ? 100 : 100 * done / count;
  std::string line =
      fmt::format("[{:#<{}}{:-<{}}] {:3} %  {} of {}", "", filled, "", kBar - filled, percent, done, count);
  if (done > 0 && done < count) {
    const auto left = std::lround(std::ceil(elapsed / static_cast<double>(done) * static_cast<double>(count - done)));
    line += fmt::format("  {}:{:02} left", left / 60, left % 60);
  }
  return line;
}

/// Shows on stderr how far the arena is: on a terminal one line that is written anew, with a bar
/// and the time that remains; elsewhere a line for each run.
class Progress {
 public:
  Progress(bool is_on, std::size_t count, std::size_t jobs)
      : is_on_(is_on),
        is_terminal_(isatty(STDERR_FILENO) != 0),
        count_(count),
        jobs_(jobs),
        begin_(std::chrono::steady_clock::now()) {
    Show();
  }

  ~Progress() { Clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more run is finished; `text` says which, and how it ended.
  void Finished(const std::string& text) {
    ++done_;
    last_ = text;
    if (is_on_ && !is_terminal_) {
      std::cerr << "[" << done_ << "/" << count_ << "] " << text << std::endl;
    }
    Show();
  }

  /// Writes the line anew, on a terminal.
  void Show() {
    if (!is_on_ || !is_terminal_ || count_ == 0) return;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
    std::string line = ProgressLine(done_, count_, elapsed.count());
    if (done_ == 0) line += "  " + std::to_string(std::min(jobs_, count_)) + " at a time";
    std::cerr << "\r\x1b[K" << line << (last_.empty() ? "" : "  ") << last_.substr(0, 50) << std::flush;
    has_line_ = true;
  }

  void Clear() {
    if (has_line_) std::cerr << "\r\x1b[K" << std::flush;
    has_line_ = false;
  }

 private:
  const bool is_on_;
  const bool is_terminal_;
  const std::size_t count_;
  const std::size_t jobs_;
  std::size_t done_ = 0;
  bool has_line_ = false;
  std::string last_;
  const std::chrono::steady_clock::time_point begin_;
};

}  // namespace runnel::arena
