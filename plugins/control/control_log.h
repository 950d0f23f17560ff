#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/clock.h"

namespace runnel {

/// What has happened to an application since its start, for those who come to look later: faults,
/// warnings, changes. The newest are kept.
///
/// Threads:  any, but not from within a cycle: locks and allocates.
class ControlLog {
 public:
  static constexpr std::size_t kMostEntries = 10'000;
  static constexpr std::size_t kLongestText = 4'000;  ///< bytes; the rest is cut off

  enum class Kind { kFault, kWarning, kChange };

  /// `clock` is the application's and must outlive this; times count from now.
  explicit ControlLog(const Clock& clock) : clock_(clock), start_(clock.Now()) {}

  void Add(Kind kind, std::string text);

  struct Lines {
    std::vector<std::string> lines;  ///< "14:31:05  12.350 s  fault    /robot/arm: …"
    std::uint64_t lost = 0;          ///< entries that were asked for and are gone
    std::uint64_t next = 0;          ///< what to ask for the next time
  };
  /// The entries from number `from` on, `most` at most. The first one has number 0.
  [[nodiscard]] Lines Read(std::uint64_t from, std::size_t most) const;

 private:
  struct Entry {
    std::chrono::system_clock::time_point wall;
    Duration time;
    Kind kind;
    std::string text;
  };
  static std::string LineOf(const Entry& entry);

  const Clock& clock_;
  const Time start_;
  mutable std::mutex mutex_;  // a leaf: nothing else is locked meanwhile
  std::deque<Entry> entries_;
  std::uint64_t first_ = 0;  // the number of the oldest that is kept
};

}  // namespace runnel
