#pragma once

#include <mutex>

#include "core/element/runtime.h"
#include "plugins/application_files/saving/saving.h"

namespace runnel::testing {

/// What would be saved in `folder`, without saving it.
inline Result<std::string> ApplicationText(FrameworkElement& application, const SaveTools& tools,
                                           const std::filesystem::path& folder) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  auto saved = internal::TextOfApplication(application, tools, folder);
  if (!saved) return saved.error();
  return std::move(saved->text);
}

}  // namespace runnel::testing
