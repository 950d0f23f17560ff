#include "core/log/log_level.h"

#include <algorithm>

#include "core/base/nearest_name.h"

namespace runnel {

const std::array<std::string, 5>& LogLevelNames() {
  static const std::array<std::string, 5> names{"debug", "info", "warning", "error", "off"};
  return names;
}

const std::string& LogLevelName(LogLevel level) {
  return LogLevelNames().at(static_cast<std::size_t>(level));
}

Result<LogLevel> LogLevelOf(std::string_view name) {
  const auto& names = LogLevelNames();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    return Error{.message = "there is no log level '" + std::string(name) + "'; " +
                            NearestNameHint(name, names)};
  }
  return static_cast<LogLevel>(found - names.begin());
}

}  // namespace runnel
