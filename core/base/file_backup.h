#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace runnel {

/// Copies a file that is about to be replaced to FILE~ beside it, as editors do, with its permission bits; the backup
/// before goes. Of a link, what it leads to is copied. Nothing if there is no such file.
///
/// Threads: one at a time for one file. Errors: the copy cannot be made; the file is as it was.
[[nodiscard]] Result<void> KeepBackup(const std::filesystem::path& file);

}  // namespace runnel
