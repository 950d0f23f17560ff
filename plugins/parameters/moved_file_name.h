#pragma once

#include <filesystem>
#include <string>

namespace runnel {

/// The file or folder, whatever name it goes by.
[[nodiscard]] std::filesystem::path Whole(const std::filesystem::path& path);

/// `name` of a file, written in one folder, as it must be written in another.
[[nodiscard]] std::string MovedFileName(const std::string& name, const std::filesystem::path& from,
                                        const std::filesystem::path& to);

}  // namespace runnel
