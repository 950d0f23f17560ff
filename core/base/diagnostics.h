#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"

namespace runnel {

/// Collects all that is wrong with a user's input, so that it is told at once rather than one by
/// one. Warnings never make an input wrong.
///
/// Threads: not thread-safe.
class Diagnostics {
 public:
  void Add(Error error) { errors_.push_back(std::move(error)); }
  void AddWarning(Error warning) { warnings_.push_back(std::move(warning)); }

  [[nodiscard]] bool ok() const noexcept { return errors_.empty(); }
  [[nodiscard]] const std::vector<Error>& errors() const noexcept { return errors_; }
  [[nodiscard]] const std::vector<Error>& warnings() const noexcept { return warnings_; }

  /// One line each, errors first, ordered by place in the file within each kind:
  /// "file:3:5: error: /robot: …".
  [[nodiscard]] std::string ToString() const;

 private:
  std::vector<Error> errors_;
  std::vector<Error> warnings_;
};

}  // namespace runnel
