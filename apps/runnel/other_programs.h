#pragma once

#include <optional>
#include <string>
#include <vector>

namespace runnel::program {

/// The commands that are programs of their own: for each executable `runnel-<name>` beside this
/// program its <name>, sorted.
[[nodiscard]] std::vector<std::string> OtherCommands();

/// Becomes the program of the command, with the words from the command on as its arguments; comes
/// back only if it cannot be started. Errors: what the system says.
std::string BecomeProgram(const std::string& command, char** words);

}  // namespace runnel::program
