#pragma once

#include <cstdint>
#include <string>

#include "core/base/clock.h"
#include "core/log/log_level.h"

namespace runnel {

/// What a module has said, as who reads the log sees it.
struct LogMessage {
  Time time{};  ///< of the cycle in which it was said, on the application's clock
  LogLevel level = LogLevel::kInfo;
  std::string path;  ///< of the element that said it; "" if messages of several are told to be lost
  std::string text;
  /// How many messages of this element and level the rate limit has left out since the one before.
  std::uint64_t left_out = 0;

  /// "no echo for 2.5 s (3 more left out)"
  [[nodiscard]] std::string TextWithCount() const;
  /// "/robot/sonar: no echo for 2.5 s (3 more left out)"
  [[nodiscard]] std::string BodyText() const;
  /// "warning  /robot/sonar: no echo for 2.5 s (3 more left out)"
  [[nodiscard]] std::string ToString() const;
};

}  // namespace runnel
