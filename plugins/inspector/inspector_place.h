#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// Where an inspector is reached, and by whom, as files and command lines say it.
struct InspectorPlace {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;  ///< 0: any that is free
  std::string token = {};     ///< "": see WebServerOptions
  bool is_read_only = false;
};

/// Reads "[ADDRESS:]PORT": "8765", "0.0.0.0:8765", "[::]:0". Errors: no such address or port, and how
/// to write them.
[[nodiscard]] Result<InspectorPlace> ParseInspectorPlace(std::string_view text);
/// 0 .. 65535. Errors: it is none.
[[nodiscard]] Result<std::uint16_t> ParseNetworkPort(std::string_view text);

}  // namespace runnel
