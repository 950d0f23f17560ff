#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/result.h"
#include "plugins/application_files/application_saver.h"

namespace runnel {

/// Whether `text`, which is to stand in `file` for `application`, would load.
///
/// Threads: under the structure lock.
[[nodiscard]] Result<void> CheckSavedText(FrameworkElement& application, std::string_view text,
                                          const std::filesystem::path& file,
                                          const SaveTools& tools);

}  // namespace runnel
