#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "plugins/mcap/mcap_records.h"

namespace runnel {

class McapReader;

/// What a person wants to know of a recording, of Runnel or of others.
struct RecordingInfo {
  struct Channel {
    std::string path;
    std::string type;
    std::string encoding;
    std::uint64_t values = 0;
    std::uint64_t dropped = 0;
    double rate = 0;       ///< Hz, over the whole recording
    bool is_view = false;  ///< shows what another channel has
  };

  std::string file;
  std::uint64_t bytes = 0;
  bool ended_properly = false;
  std::optional<Error> damage = {};
  std::string library = {};
  McapTexts about = {};  ///< "application", "clock", …; empty if it is not of Runnel
  std::vector<std::string> attachments = {};
  double start = 0;  ///< s, on the clock of what was recorded
  double end = 0;
  std::size_t ports = 0;     ///< channels but for views
  std::uint64_t values = 0;  ///< of these
  std::uint64_t dropped = 0;
  std::uint64_t chunks = 0;
  std::string compression = {};  ///< "zstd", "none", "lz4, zstd"
  std::uint64_t compressed_bytes = 0;
  std::uint64_t uncompressed_bytes = 0;
  std::vector<Channel> channels = {};  ///< by path

  [[nodiscard]] double duration() const noexcept { return end - start; }
};

[[nodiscard]] RecordingInfo InfoOf(const McapReader& reader);

/// What the recording says of itself under `key`; "" if nothing.
[[nodiscard]] std::string AboutText(const McapReader& reader, std::string_view key);

/// As one JSON object.
[[nodiscard]] std::string RecordingInfoJson(const RecordingInfo& info);

/// "1.2 MB".
[[nodiscard]] std::string SizeText(std::uint64_t bytes);

}  // namespace runnel
