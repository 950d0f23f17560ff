#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace runnel {

/// The names of what is in `folder`, sorted, "." and ".." left out; none if it is not there or cannot be
/// read. Throws std::bad_alloc only. Threads: any.
[[nodiscard]] std::vector<std::string> NamesInFolder(const std::filesystem::path& folder);

}  // namespace runnel
