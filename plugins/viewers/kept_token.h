#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"

namespace runnel {

/// A token in a file that only this user can read, for as long as this lives.
class KeptToken {
 public:
  /// In the folder of the sockets by which this user's applications are reached (plugins/control). Errors: it cannot
  /// be written there.
  static Result<std::unique_ptr<KeptToken>> Write(const std::string& token, std::uint16_t port);
  ~KeptToken();
  KeptToken(const KeptToken&) = delete;
  KeptToken& operator=(const KeptToken&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  explicit KeptToken(std::filesystem::path file) : file_(std::move(file)) {}

  const std::filesystem::path file_;
};

}  // namespace runnel
