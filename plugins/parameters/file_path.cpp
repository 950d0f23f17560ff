#include "plugins/parameters/file_path.h"

namespace runnel {

namespace {

const std::string& TextIn(const void* value) { return static_cast<const FilePath*>(value)->text; }

Result<void> FromText(std::string_view text, void* value) {
  if (text.find('\0') != std::string_view::npos) {
    return Error{.message = "a file name contains no zero byte"};
  }
  static_cast<FilePath*>(value)->text = text;
  return {};
}

}  // namespace

void Describe(TypeBuilder<FilePath>& type) {
  type.Name("FilePath")
      .Leaf({.to_text = [](const void* value) { return TextIn(value); }, .from_text = FromText, .needs_quotes = true});
}

FilePath ResolvedAgainst(const std::filesystem::path& folder, const FilePath& file) {
  if (file.empty() || file.path().is_absolute()) return file;
  return {(folder / file.path()).lexically_normal().string()};
}

namespace fs = std::filesystem;

fs::path Whole(const fs::path& path) {
  std::error_code ignored;
  // The folder of a bare name is "", of which nothing is absolute.
  return fs::weakly_canonical(fs::absolute(path.empty() ? fs::path(".") : path, ignored), ignored);
}

std::string MovedFileName(const std::string& name, const fs::path& from, const fs::path& to) {
  if (name.empty() || fs::path(name).is_absolute()) return name;
  const fs::path moved = Whole(from / name).lexically_relative(Whole(to));
  return moved.empty() ? name : moved.string();
}

}  // namespace runnel
