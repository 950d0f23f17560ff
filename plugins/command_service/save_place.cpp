#include "plugins/command_service/save_place.h"

#include <filesystem>
#include <system_error>

namespace runnel {

namespace {

namespace fs = std::filesystem;

bool IsAtOrBelow(const fs::path& path, const fs::path& folder) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end();
}

}  // namespace

Result<std::string> SavePlace(const std::string& application_file, const std::string& wanted) {
  const fs::path asked(wanted);
  if (asked.extension() != ".xml") {
    return Error{.message = "'" + wanted + "' is not the name of an XML file", .hint = "end it in .xml"};
  }
  if (application_file.empty()) {
    if (!asked.has_parent_path()) return wanted;
    return Error{.message = "viewers cannot save to '" + wanted + "'", .hint = "give a name without a folder"};
  }
  std::error_code error;
  // Whole first: the folder of a mere name is "", and everything is below that.
  const fs::path whole = fs::absolute(application_file, error);
  const fs::path folder = error ? fs::path() : fs::weakly_canonical(whole.parent_path(), error);
  const fs::path place = error ? fs::path() : fs::weakly_canonical(folder / asked, error);
  // What is still a link leads to something that is not there yet.
  const bool is_link = !error && fs::is_symlink(fs::symlink_status(place, error));
  if (!is_link && !place.empty() && IsAtOrBelow(place.parent_path(), folder)) return place.string();
  return Error{.message = "viewers cannot save to '" + wanted + "'",
               .hint = "they may in " + folder.string() + ", and below"};
}

}  // namespace runnel
