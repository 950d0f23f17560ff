#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// Makes `text` the whole of a file, at once: whoever looks at it, also after the program has been
/// killed or the power has gone, finds the old file or the new one, whole. The text goes to a new
/// file in the same folder, which takes the name of the old when it is safe on the disk. Permission
/// bits stay; of a link, what it leads to is replaced.
///
/// Threads: any, also several for one file. Errors: the old file is as it was.
[[nodiscard]] Result<void> ReplaceFile(const std::filesystem::path& file, std::string_view text);

/// Copies a file that is about to be replaced to FILE~ beside it, as editors do, with its permission bits; the backup
/// before goes. Of a link, what it leads to is copied. Nothing if there is no such file.
///
/// Threads: one at a time for one file. Errors: the copy cannot be made; the file is as it was.
[[nodiscard]] Result<void> KeepBackup(const std::filesystem::path& file);

/// All that is in a file; nullopt if it is none, or cannot be read. Threads: any.
[[nodiscard]] std::optional<std::string> TextOfFile(const std::filesystem::path& file);

/// The names of what is in `folder`, sorted, "." and ".." left out; none if it is not there or cannot be
/// read. Throws std::bad_alloc only. Threads: any.
[[nodiscard]] std::vector<std::string> NamesInFolder(const std::filesystem::path& folder);

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
