#pragma once

#include <filesystem>
#include <fstream>
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

}  // namespace runnel::arena
