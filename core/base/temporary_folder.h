#pragma once

#include <filesystem>
#include <string_view>
#include <utility>

#include "core/base/result.h"

namespace runnel {

/// A new folder among the system's temporary files (TMPDIR), which goes with this object and all that is in it by then.
class TemporaryFolder {
 public:
  /// `purpose` is a part of its name, for who finds it after a crash. Errors: with the system's words.
  static Result<TemporaryFolder> Make(std::string_view purpose);
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

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
