#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// How the chunks of a file are compressed: "zstd", "lz4", or "" for not at all, as MCAP names them.

/// The best one first.
[[nodiscard]] std::vector<std::string> Compressions();

/// "" or an error that names those that are there.
[[nodiscard]] Result<void> CheckCompression(const std::string& compression);

/// Replaces `compressed`. Precondition: CheckCompression().
Result<void> Compress(const std::string& compression, std::string_view bytes, std::string& compressed);

/// Replaces `bytes` by `size` bytes. Errors: what is compressed is broken, or of another size.
/// Precondition: CheckCompression().
Result<void> Decompress(const std::string& compression, std::string_view compressed, std::uint64_t size,
                        std::string& bytes);

}  // namespace runnel
