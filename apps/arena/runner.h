#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/arena/arguments.h"
#include "apps/arena/matrix.h"

namespace runnel::arena {

/// A folder of temporary files that is removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();  ///< throws std::system_error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Makes the runs, several at a time, each the product's program in a process of its own.
class Runner {
 public:
  struct Callbacks {
    std::function<Result<void>(const PlannedRun&, const RunRecord&)> finished;
    std::function<void()> tick;        ///< a few times a second
    std::function<bool()> is_to_stop;  ///< then those that run are ended, and not told of
  };

  Runner(const ArenaArguments& arguments, const Product& product, const Matrix& matrix)
      : arguments_(arguments), product_(product), matrix_(matrix) {}

  /// In this order, but they end in another. Errors: no process can be started, a temporary file
  /// cannot be written, or what `finished` says; the runs that are under way are ended.
  Result<void> Run(const std::vector<const PlannedRun*>& runs, const Callbacks& callbacks);

 private:
  const ArenaArguments& arguments_;
  const Product& product_;
  const Matrix& matrix_;
};

}  // namespace runnel::arena
