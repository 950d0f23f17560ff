#pragma once

#include <filesystem>
#include <utility>

#include "core/base/result.h"

namespace runnel {

/// A copy of a file under a path that no file has had before, until this goes: the dynamic linker takes
/// libraries of one path for one library, whatever has become of the file.
class TemporaryCopy {
 public:
  /// Errors: with the file and the system's words.
  static Result<TemporaryCopy> Make(const std::filesystem::path& file);
  ~TemporaryCopy();
  TemporaryCopy(TemporaryCopy&& other) noexcept : file_(std::exchange(other.file_, {})) {}
  TemporaryCopy& operator=(TemporaryCopy&&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  explicit TemporaryCopy(std::filesystem::path file) : file_(std::move(file)) {}
  std::filesystem::path file_;
};

}  // namespace runnel
