#pragma once

#include <filesystem>
#include <vector>

#include <sys/types.h>

#include "core/base/file_descriptor.h"
#include "core/base/result.h"

namespace runnel {

/// Where the sockets of this user's running applications are: $XDG_RUNTIME_DIR/runnel, or
/// /tmp/runnel-<uid> where there is none.
[[nodiscard]] std::filesystem::path ControlFolder();

/// Makes the folder, for its owner only, unless it is there. Errors: it is a link or a file, belongs to
/// somebody else, is open to others, or cannot be made. Nothing in such a folder can be trusted.
Result<void> MakeControlFolder(const std::filesystem::path& folder);

/// The same checks; a folder that is not there is no error.
Result<void> CheckControlFolder(const std::filesystem::path& folder);

/// The sockets in the folder that somebody listens to, by process and then by name. Those that a dead
/// process has left are removed. Errors: those of CheckControlFolder().
[[nodiscard]] Result<std::vector<std::filesystem::path>> FindControlSockets(const std::filesystem::path& folder);

/// A socket connected to `path`, whose reading and writing waits. Errors: nobody listens there, or the path is too long.
[[nodiscard]] Result<FileDescriptor> ConnectToSocket(const std::filesystem::path& path);

/// A socket that listens at a name of its own in the folder, for its owner only, and its path.
struct ListeningSocket {
  FileDescriptor socket;
  std::filesystem::path path;
};
[[nodiscard]] Result<ListeningSocket> ListenInFolder(const std::filesystem::path& folder);

}  // namespace runnel
