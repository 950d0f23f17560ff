#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// --record and what belongs to it, for commands that run an application.
void AddRecordOptions(CLI::App& command, RecordArguments& arguments);

/// The commands `replay` and `info`. Parsing keeps addresses: one place, until it is over.
class RecordingCommandLine {
 public:
  explicit RecordingCommandLine(CLI::App& program);
  RecordingCommandLine(const RecordingCommandLine&) = delete;
  RecordingCommandLine& operator=(const RecordingCommandLine&) = delete;

  [[nodiscard]] static const std::vector<std::string>& Names();
  /// What `replay` runs its application with, beside what is said here, is added by the caller.
  [[nodiscard]] CLI::App& replay() noexcept { return *replay_; }
  [[nodiscard]] RunArguments& replay_arguments() noexcept { return replay_arguments_; }
  /// nullopt if another command was given.
  [[nodiscard]] std::optional<CommandLine> Parsed() const;

 private:
  void AddReplay();

  CLI::App* replay_;
  CLI::App* info_;
  RunArguments replay_arguments_;
  ReplayArguments replayed_;
  InfoArguments info_arguments_;
};

}  // namespace runnel::program
