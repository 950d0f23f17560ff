#pragma once

#include <filesystem>
#include <string>

#include "plugins/application_files/saving/application_saver.h"

namespace runnel {

/// What saving would do to a file.
struct SavePreview {
  std::filesystem::path file;
  std::string before;  ///< what is in it now; "": there is none
  std::string after;
};

/// What SaveApplication() with the same arguments would write, and what it would replace; nothing is written, and whether
/// the text would load is not tried.
///
/// Threads: any outside of cycles; holds the structure lock meanwhile.
/// Errors: as SaveApplication(), but for a file that has been changed: the difference shows it.
[[nodiscard]] Result<SavePreview> PreviewSave(FrameworkElement& application,
                                              const SaveTools& tools,
                                              const std::filesystem::path& file = {});

}  // namespace runnel
