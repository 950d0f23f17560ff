#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace runnel::arena {

/// Shows on stderr how far the arena is: on a terminal one line that is written anew, with a bar
/// and the time that remains; elsewhere a line for each run.
class Progress {
 public:
  Progress(bool is_on, std::size_t count, std::size_t jobs);
  ~Progress() { Clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more run is finished; `text` says which, and how it ended.
  void Finished(const std::string& text);
  /// Writes the line anew, on a terminal.
  void Show();
  void Clear();

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

/// "[#####-----]  50 %  30 of 60  0:21 left".
[[nodiscard]] std::string ProgressLine(std::size_t done, std::size_t count, double elapsed);

}  // namespace runnel::arena
