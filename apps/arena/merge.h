#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"

namespace runnel::arena {

/// Puts the runs of several arenas into one: `into` and its journal get those of all the `parts`, JSON files that arenas
/// have written (--json), each with its journal beside it. Parts that were interrupted count as far as they came. How many
/// runs there are then.
///
/// Errors: a part without a journal, journals of other settings, one run made of two different worlds or applications;
///         `into` is not written then.
[[nodiscard]] Result<std::size_t> Merge(const std::filesystem::path& into,
                                        const std::vector<std::filesystem::path>& parts);

/// The words after `runnel arena merge`. Errors: as above, and what the parser says; without a message, help has been
/// printed.
[[nodiscard]] Result<void> RunMerge(int count, const char* const* words);

}  // namespace runnel::arena
