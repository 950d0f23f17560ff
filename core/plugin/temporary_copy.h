#pragma once

#include <filesystem>
#include <utility>

#include "core/base/result.h"
#include "core/base/temporary_folder.h"

namespace runnel {

/// A copy of a file under a path that no file has had before, until this goes: the dynamic linker takes
/// libraries of one path for one library, whatever has become of the file.
class TemporaryCopy {
 public:
  /// Errors: with the file and the system's words.
  static Result<TemporaryCopy> Make(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  TemporaryCopy(TemporaryFolder folder, std::filesystem::path file)
      : folder_(std::move(folder)), file_(std::move(file)) {}

  TemporaryFolder folder_;
  std::filesystem::path file_;
};

}  // namespace runnel
