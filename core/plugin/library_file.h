#pragma once

#include <filesystem>

#include "core/base/result.h"

namespace runnel {

/// Whether all of a shared library is in the file, by what its own head says of its length. The file is read and not
/// mapped: whoever maps one that lacks its end is ended by the system (SIGBUS) as soon as it looks there.
///
/// Threads:  any. Errors: it cannot be read; it is no ELF file; it is cut short, or its end has not been written yet.
[[nodiscard]] Result<void> CheckIsWhole(const std::filesystem::path& file);

}  // namespace runnel
