#include "core/plugin/temporary_copy.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <stdlib.h>

#include "core/base/retry.h"

namespace runnel {

namespace fs = std::filesystem;

Result<TemporaryCopy> TemporaryCopy::Make(const fs::path& file) {
  const auto failed = [&](const std::error_code& why) {
    return Error{.message = "cannot copy " + file.string() + ": " + why.message(),
                 .hint = "TMPDIR names the folder for the copy"};
  };
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  if (error) return failed(error);
  std::string folder = (temporary / "runnel-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return failed({errno, std::generic_category()});
  TemporaryCopy copy(fs::path(folder) / file.filename());
  fs::copy_file(file, copy.file_, error);
  if (error) return failed(error);
  return copy;
}

TemporaryCopy::~TemporaryCopy() {
  if (file_.empty()) return;
  std::error_code ignored;  // a copy that stays harms nobody
  Retry([&] { fs::remove_all(file_.parent_path(), ignored); });
}

}  // namespace runnel
