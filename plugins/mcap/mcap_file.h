#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// A file that is read at any place. What another process adds to it meanwhile is not seen.
///
/// Threads: one at a time.
class McapFile {
 public:
  /// Errors: it is not there, may not be read, or is no file.
  static Result<std::unique_ptr<McapFile>> Open(const std::string& file);
  ~McapFile();
  McapFile(const McapFile&) = delete;
  McapFile& operator=(const McapFile&) = delete;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

  /// Replaces `bytes` by `count` bytes from `offset` on. Errors: the file has no more so many.
  Result<void> Read(std::uint64_t offset, std::uint64_t count, std::string& bytes);
  /// At most `count` bytes from `offset` on, fewer only at the end; valid until the next call. Reads
  /// ahead. Precondition: count <= kWindow.
  Result<std::string_view> Look(std::uint64_t offset, std::uint64_t count);
  static constexpr std::uint64_t kWindow = 1 << 16;

  /// "at byte 120: …", in this file.
  [[nodiscard]] Error ErrorAt(std::uint64_t offset, const std::string& message) const;

 private:
  McapFile(std::string name, int descriptor, std::uint64_t size);

  const std::string name_;
  const int descriptor_;
  const std::uint64_t size_;
  std::string window_;
  std::uint64_t window_offset_ = 0;
};

}  // namespace runnel
