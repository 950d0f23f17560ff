#include "plugins/mcap/compression.h"

#include <algorithm>

#include <lz4frame.h>
#include <zstd.h>

namespace runnel {

namespace {

// A run's worth of JSON is compressed to a tenth by the quickest level already.
constexpr int kLevel = 1;

Error Broken(const std::string& compression, const std::string& why) {
  return {.message = "what is compressed with " + compression + " cannot be decompressed: " + why};
}

Result<void> CompressZstd(std::string_view bytes, std::string& compressed) {
  compressed.resize(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(compressed.data(), compressed.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size) != 0) return Error{.message = ZSTD_getErrorName(size)};
  compressed.resize(size);
  return {};
}
Result<void> DecompressZstd(std::string_view compressed, std::string& bytes) {
  const std::size_t size = ZSTD_decompress(bytes.data(), bytes.size(), compressed.data(), compressed.size());
  if (ZSTD_isError(size) != 0) return Broken("zstd", ZSTD_getErrorName(size));
  if (size != bytes.size()) return Broken("zstd", "it is shorter than it says");
  return {};
}

Result<void> CompressLz4(std::string_view bytes, std::string& compressed) {
  compressed.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
  const std::size_t size =
      LZ4F_compressFrame(compressed.data(), compressed.size(), bytes.data(), bytes.size(), nullptr);
  if (LZ4F_isError(size) != 0) return Error{.message = LZ4F_getErrorName(size)};
  compressed.resize(size);
  return {};
}
Result<void> DecompressLz4(std::string_view compressed, std::string& bytes) {
  LZ4F_dctx* context = nullptr;
  if (const auto made = LZ4F_createDecompressionContext(&context, LZ4F_VERSION); LZ4F_isError(made) != 0) {
    return Error{.message = LZ4F_getErrorName(made)};
  }
  std::size_t filled = 0;
  std::size_t hint = 1;
  // Ends when the frame does, or when there is nothing left to read or no room left to write.
  while (hint != 0) {
    std::size_t read = compressed.size();
    std::size_t written = bytes.size() - filled;
    hint = LZ4F_decompress(context, bytes.data() + filled, &written, compressed.data(), &read, nullptr);
    compressed.remove_prefix(read);
    filled += written;
    if (LZ4F_isError(hint) != 0 || (read == 0 && written == 0)) break;
  }
  (void)LZ4F_freeDecompressionContext(context);
  if (LZ4F_isError(hint) != 0) return Broken("lz4", LZ4F_getErrorName(hint));
  if (hint != 0) return Broken("lz4", "it does not end where it says");
  if (filled != bytes.size()) return Broken("lz4", "it is shorter than it says");
  return {};
}

}  // namespace

std::vector<std::string> Compressions() { return {"zstd", "lz4", ""}; }

Result<void> CheckCompression(const std::string& compression) {
  if (std::ranges::count(Compressions(), compression) > 0) return {};
  return Error{.message = "the compression '" + compression + "' is not there", .hint = "there is zstd, lz4, none"};
}

Result<void> Compress(const std::string& compression, std::string_view bytes, std::string& compressed) {
  if (compression == "zstd") return CompressZstd(bytes, compressed);
  if (compression == "lz4") return CompressLz4(bytes, compressed);
  if (auto known = CheckCompression(compression); !known) return known;
  compressed = bytes;
  return {};
}

Result<void> Decompress(const std::string& compression, std::string_view compressed, std::uint64_t size,
                        std::string& bytes) {
  if (auto known = CheckCompression(compression); !known) return known;
  bytes.resize(size);
  if (compression == "zstd") return DecompressZstd(compressed, bytes);
  if (compression == "lz4") return DecompressLz4(compressed, bytes);
  if (compressed.size() != size) return Broken("none", "it is not as long as it says");
  bytes = compressed;
  return {};
}

}  // namespace runnel
