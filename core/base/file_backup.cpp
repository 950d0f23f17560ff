#include "core/base/file_backup.h"

#include <string>
#include <system_error>

namespace runnel {

namespace fs = std::filesystem;

Result<void> KeepBackup(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  const fs::path real = fs::canonical(file, error);
  const fs::path backup = real.string() + "~";
  // A link of that name would be followed otherwise.
  if (!error) fs::remove(backup, error);
  if (!error) fs::copy_file(real, backup, error);
  if (!error) return {};
  return Error{.message = "what is in it cannot be kept as " + backup.filename().string() + ": " + error.message(),
               .position = {file.string()}};
}

}  // namespace runnel
