#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// Makes `text` the whole of a file, at once: whoever looks at it, also after the program has been
/// killed or the power has gone, finds the old file or the new one, whole. The text goes to a new
/// file in the same folder, which takes the name of the old when it is safe on the disk. Permission
/// bits stay; of a link, what it leads to is replaced.
///
/// Threads: any, also several for one file. Errors: the old file is as it was.
[[nodiscard]] Result<void> ReplaceFile(const std::filesystem::path& file, std::string_view text);

}  // namespace runnel
