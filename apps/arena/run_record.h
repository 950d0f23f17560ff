#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "modules/simulation/algorithm/path_record.h"

namespace runnel::arena {

/// Which run it is.
struct RunKey {
  std::string world;
  std::string variant;
  std::string sensor;
  std::string direction;
  std::uint64_t seed = 1;

  friend auto operator<=>(const RunKey&, const RunKey&) = default;
};

/// For progress lines and remarks: "spiral bug1 laser left 1".
[[nodiscard]] std::string TextOf(const RunKey& key);
/// For files: "spiral-bug1-laser-left-1".
[[nodiscard]] std::string FileNameOf(const RunKey& key);

/// What has become of a run.
struct RunRecord {
  RunKey key;
  RunResult result = {};
  double wall_time = 0.0;                    ///< s
  double processor_time = 0.0;               ///< s, less than that where processes wait for their turn
  bool has_ended_by_itself = true;           ///< false: crashed, or ended because it hung
  double noise = 0.0;                        ///< m, of the ranges
  std::optional<double> shortest_path = {};  ///< m, Course::shortest; none: the goal cannot be reached
};

/// What the referee has written (JsonOf). Errors: it is no such thing.
[[nodiscard]] Result<RunResult> ParseRunResult(std::string_view text);

/// An object in one line: the published format, as the README has it.
[[nodiscard]] std::string JsonOf(const RunRecord& record);
/// The records as the published list.
[[nodiscard]] std::string JsonOf(const std::vector<RunRecord>& records);

/// The same with all that the arena itself wants to know again, and what it was made of.
[[nodiscard]] std::string JournalLineOf(const RunRecord& record, std::string_view made_of);
struct JournalEntry {
  RunRecord record;
  std::string made_of;
};
[[nodiscard]] Result<JournalEntry> ParseJournalLine(std::string_view line);

}  // namespace runnel::arena
