#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel::program {

/// The commands that are programs of their own: for each executable `runnel-<name>` beside this
/// program its <name>, sorted.
[[nodiscard]] std::vector<std::string> OtherCommands();

/// Becomes the program of the command, with the words from the command on as its arguments; comes
/// back only if it cannot be started. Errors: what the system says.
std::string BecomeProgram(const std::string& command, char** words);

/// Returns if `libraries` have been in this process from its start. Else starts the program anew in this process, with
/// the same words and with the libraries. Errors: one of them is not there, or the system's words.
[[nodiscard]] Result<void> PreloadAll(const std::vector<std::string>& libraries);

}  // namespace runnel::program
