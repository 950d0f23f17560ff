#pragma once

#include <filesystem>
#include <optional>

namespace runnel {

/// The first of the libraries that the one in `file` needs, itself or by others, that has been built anew since
/// it was loaded into this process: what was compiled with the new one would be run with the old one, as a
/// library that is there is never loaded a second time. nullopt: all are as they were.
///
/// Effort:  reads all of them from disk.
[[nodiscard]] std::optional<std::filesystem::path> FindOutdatedDependency(
    const std::filesystem::path& file);

}  // namespace runnel
