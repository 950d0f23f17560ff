#include "core/plugin/temporary_copy.h"

#include <string>
#include <system_error>

namespace runnel {

namespace fs = std::filesystem;

Result<TemporaryCopy> TemporaryCopy::Make(const fs::path& file) {
  const auto failed = [&](const std::string& why) {
    return Error{.message = "cannot copy " + file.string() + ": " + why, .hint = "TMPDIR names the folder for the copy"};
  };
  Result<TemporaryFolder> folder = TemporaryFolder::Make("copy");
  if (!folder) return failed(folder.error().message);
  const fs::path copy = folder->path() / file.filename();
  std::error_code error;
  fs::copy_file(file, copy, error);
  if (error) return failed(error.message());
  return TemporaryCopy(*std::move(folder), copy);
}

}  // namespace runnel
