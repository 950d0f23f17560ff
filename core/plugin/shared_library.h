#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace runnel {

/// A shared library in memory. It is never unmapped: types, vtables and strings of it may live on
/// in objects that nobody can count.
///
/// Threads:  as dlopen().
class SharedLibrary {
 public:
  /// Errors: with the dynamic linker's own words.
  static Result<SharedLibrary> Open(const std::filesystem::path& file);

  /// nullptr if the library does not export it.
  [[nodiscard]] void* FindSymbol(const char* name) const noexcept;
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  SharedLibrary(std::filesystem::path file, void* handle)
      : file_(std::move(file)), handle_(handle) {}

  std::filesystem::path file_;
  void* handle_;
};

}  // namespace runnel
