#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// What is wrong with the text of an operator's panel: {"panel":1,"widgets":[{"id","kind","x","y","w","h", …}]}, on a
/// grid of 12 columns. Errors: it is no JSON, is too long, a widget is of no known kind, lies beside the grid, has a
/// member that no widget has, or another one's id.
[[nodiscard]] Result<void> CheckPanel(std::string_view text);

/// The operator's panel of an application: a file NAME.panel.json beside the file NAME.xml that it came from. Of an
/// application that came from no file it is kept as long as this lives.
///
/// Threads: any. May wait for the disk.
class PanelFile {
 public:
  explicit PanelFile(const std::string& application_file);

  /// "": there is none, it is in memory only.
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  /// As it was saved last; "" if it never was. Errors: it cannot be read, or is no panel.
  [[nodiscard]] Result<std::string> Read() const;
  /// All or nothing. What was done, for people. Errors: it is no panel; it cannot be written.
  Result<std::string> Save(const std::string& text);

 private:
  const std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::string kept_;  // guarded by mutex_; without a file
};

}  // namespace runnel
