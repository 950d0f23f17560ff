#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <vector>

#include "apps/arena/arguments.h"
#include "apps/arena/matrix.h"
#include "apps/arena/run_record.h"
#include "core/base/result.h"

namespace runnel::arena {

/// The runs that are finished, a line each, written as they end: what is there survives whatever
/// happens to the arena. The first line has the settings. It stands beside the JSON file.
class Journal {
 public:
  /// Begins a new one. Errors: the file cannot be written.
  static Result<Journal> Begin(const std::filesystem::path& file, const RunSettings& settings);
  /// Goes on with the one that is there, or begins a new one if there is none. Errors: the file is
  /// no journal, or has been written with other settings (told in words).
  static Result<Journal> Resume(const std::filesystem::path& file, const RunSettings& settings);

  /// The record of this run, if it is finished, and made of the same world and application. A run
  /// that crashed or hung is not finished. nullptr: it is still to be done.
  [[nodiscard]] const RunRecord* Find(const PlannedRun& run) const;
  Result<void> Add(const RunRecord& record, const std::string& made_of);

 private:
  explicit Journal(std::filesystem::path file) : file_(std::move(file)) {}

  std::filesystem::path file_;
  std::map<RunKey, JournalEntry> finished_;
};

/// Calls `use` with each run that the text of a journal has, its line and its line's number. The last line is left out if it is
/// cut off: the arena may have been killed while it wrote it. Errors: a line is broken, or what `use` says.
using UseJournalEntry = std::function<Result<void>(const JournalEntry& entry, const std::string& line, int number)>;
Result<void> ReadEntries(const std::filesystem::path& file, const std::string& text, const UseJournalEntry& use);

/// Puts the runs of several arenas into one: `into` and its journal get those of all the `parts`, JSON files that arenas
/// have written (--json), each with its journal beside it. Parts that were interrupted count as far as they came. How many
/// runs there are then.
///
/// Errors: a part without a journal, journals of other settings, one run made of two different worlds or applications;
///         `into` is not written then.
[[nodiscard]] Result<std::size_t> Merge(const std::filesystem::path& into,
                                        const std::vector<std::filesystem::path>& parts);

/// `runnel arena merge`, with the words from there on. Returns the exit code.
[[nodiscard]] int RunMerge(int count, const char* const* words);

}  // namespace runnel::arena
