#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/log/log_sink.h"

namespace runnel {

/// What has happened to an application since its start, for those who come to look later: faults,
/// warnings, changes, and what its modules say. The newest are kept.
///
/// Threads:  any, but not from within a cycle: locks and allocates.
class ApplicationLog {
 public:
  static constexpr std::size_t kMostEntries = 10'000;
  static constexpr std::size_t kLongestText = 4'000;  ///< bytes; the rest is cut off

  enum class Kind { kFault, kWarning, kChange, kError, kInfo, kDebug };

  /// `clock` is the application's and must outlive this; times count from now.
  explicit ApplicationLog(const Clock& clock) : clock_(clock), start_(clock.Now()) {}

  /// `module`: the path of one that has thrown; `cause`: what it has thrown, if that has stopped it. What there
  /// is no memory for is not kept.
  void Add(Kind kind, std::string text, std::string module = {}, std::string cause = {}) noexcept;

  /// What a module has said: a warning, an error …, at the time at which it was said.
  void Add(const LogMessage& message) noexcept;

  /// "fault", "warning", "change", "error", "info", "debug".
  [[nodiscard]] static const char* KindName(Kind kind) noexcept;

  /// What has happened, as it was added.
  struct Entry {
    std::uint64_t number = 0;  ///< of the first: 0
    std::chrono::system_clock::time_point wall;
    Duration time{};  ///< on the application's clock
    Kind kind = Kind::kChange;
    std::string text;
    std::string module;
    std::string cause;
  };
  struct Entries {
    std::vector<Entry> entries;
    std::uint64_t lost = 0;  ///< that were asked for and are gone
    std::uint64_t next = 0;  ///< what to ask for the next time
  };
  /// The entries from number `from` on, `most` at most.
  [[nodiscard]] Entries ReadEntries(std::uint64_t from, std::size_t most) const;
  /// The number that the next entry will have.
  [[nodiscard]] std::uint64_t end() const;
  /// The zero of the times that people see.
  [[nodiscard]] Time start() const noexcept { return start_; }
  /// How often a module has thrown.
  [[nodiscard]] std::uint64_t faults() const;

  /// The entry as who reads messages of modules sees it: a change is of level info, a fault an error.
  [[nodiscard]] LogMessage MessageOf(const Entry& entry) const;

  /// "14:31:05  12.350 s  fault    /robot/arm: …"
  [[nodiscard]] static std::string LineOf(const Entry& entry);

 private:
  void Keep(Entry entry);

  const Clock& clock_;
  const Time start_;
  mutable std::mutex mutex_;  // a leaf: nothing else is locked meanwhile
  std::deque<Entry> entries_;
  std::uint64_t faults_ = 0;
  std::uint64_t first_ = 0;  // the number of the oldest that is kept
};

}  // namespace runnel
