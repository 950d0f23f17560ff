#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "plugins/command_service/application_log.h"

namespace runnel::program {

/// A text file into which what happens to an application is written as it happens: `runnel run --log FILE`.
class LogFile {
 public:
  /// What was in the file before goes. Errors: Failure().
  explicit LogFile(std::string file) : file_(std::move(file)), stream_(file_) {}

  /// What has come since the last call.
  void Append(const ApplicationLog& log);
  /// Why not all of it is in the file.
  [[nodiscard]] std::optional<Error> Failure() const;

 private:
  std::string file_;
  std::ofstream stream_;
  std::uint64_t next_ = 0;
};

}  // namespace runnel::program
