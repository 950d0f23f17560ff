#include "core/base/temporary_folder.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <stdlib.h>

#include "core/base/retry.h"

namespace runnel {

namespace fs = std::filesystem;

Result<TemporaryFolder> TemporaryFolder::Make(std::string_view purpose) {
  const auto failed = [](const std::error_code& why) {
    return Error{.message = "cannot make a temporary folder: " + why.message(),
                 .hint = "TMPDIR names the folder for temporary files"};
  };
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  if (error) return failed(error);
  std::string folder = (temporary / "runnel-").string().append(purpose).append("-XXXXXX");
  if (mkdtemp(folder.data()) == nullptr) return failed({errno, std::generic_category()});
  return TemporaryFolder(folder);
}

TemporaryFolder::~TemporaryFolder() {
  if (path_.empty()) return;
  std::error_code ignored;  // a folder that stays harms nobody
  Retry([&] { fs::remove_all(path_, ignored); });
}

Result<TemporaryCopy> TemporaryCopy::Make(const fs::path& file) {
  const auto failed = [&](const std::string& why) {
    return Error{.message = "cannot copy " + file.string() + ": " + why,
                 .hint = "TMPDIR names the folder for the copy"};
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
