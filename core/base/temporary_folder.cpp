#include "core/base/temporary_folder.h"

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include <ftw.h>
#include <stdlib.h>

namespace runnel {

namespace fs = std::filesystem;

namespace {
constexpr int kOpenFolders = 16;
}

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

// By the C library: the iterators that the C++ library removes by end the process where there is no memory.
TemporaryFolder::~TemporaryFolder() {
  if (path_.empty()) return;
  const auto remove_one = [](const char* path, const struct stat*, int, FTW*) {
    (void)std::remove(path);  // what stays harms nobody
    return 0;
  };
  (void)nftw(path_.c_str(), remove_one, kOpenFolders, FTW_DEPTH | FTW_PHYS);
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
