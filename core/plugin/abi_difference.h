#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// Why code that was built with one fingerprint (`plugin_entry.h`) cannot use classes of another, for people.
struct AbiDifference {
  std::string why;   ///< "it is built for AVX-512, this core is not"
  std::string cure;  ///< "build the plugin without -march=native, -mavx512f and the like"
};

/// What differs between the fingerprint of a plugin and that of the core; the compiler, where none of its flags
/// does. Any thread; allocates.
[[nodiscard]] AbiDifference FindAbiDifference(std::string_view plugin, std::string_view core);

/// Whether all of a shared library is in the file, by what its own head says of its length, and so those that it needs and
/// that are not in memory yet. It is read and not mapped: whoever maps a file that lacks its end is ended by the system (SIGBUS)
/// as soon as it looks there. Errors: it cannot be read; it is no ELF file; it is cut short, or its end has not been written
/// yet. Any thread. Libraries in the system's own folders are not looked at.
[[nodiscard]] Result<void> CheckIsWhole(const std::filesystem::path& file);

/// The first of the libraries that the one in `file` needs, itself or by others, that has been built anew since
/// it was loaded into this process: what was compiled with the new one would be run with the old one, as a
/// library that is there is never loaded a second time. nullopt: all are as they were.
///
/// Effort:  reads all of them from disk.
[[nodiscard]] std::optional<std::filesystem::path> FindOutdatedDependency(const std::filesystem::path& file);

}  // namespace runnel
