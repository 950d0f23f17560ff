#pragma once

#include <filesystem>
#include <string>

#include "core/types/type_of.h"

namespace runnel {

/// The name of a file as the value of a parameter. Unlike a plain text, whoever sets it from a file
/// knows that relative names in it start in the folder of that file.
struct FilePath {
  std::string text;

  [[nodiscard]] bool empty() const noexcept { return text.empty(); }
  [[nodiscard]] std::filesystem::path path() const { return text; }

  friend bool operator==(const FilePath&, const FilePath&) = default;
};

/// The text format is the name itself.
void Describe(TypeBuilder<FilePath>& type);

/// `file` as seen from where the program runs, if it was written in `folder`. Absolute names and
/// the empty one stay as they are.
[[nodiscard]] FilePath ResolvedAgainst(const std::filesystem::path& folder, const FilePath& file);

/// The file or folder, whatever name it goes by.
[[nodiscard]] std::filesystem::path Whole(const std::filesystem::path& path);

/// `name` of a file, written in one folder, as it must be written in another.
[[nodiscard]] std::string MovedFileName(const std::string& name, const std::filesystem::path& from,
                                        const std::filesystem::path& to);

}  // namespace runnel
