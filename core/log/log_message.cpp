#include "core/log/log_message.h"

#include <fmt/format.h>

namespace runnel {

std::string LogMessage::BodyText() const {
  std::string body = fmt::format("{}{}{}", path, path.empty() ? "" : ": ", text);
  if (left_out > 0) body += fmt::format(" ({} more left out)", left_out);
  return body;
}

std::string LogMessage::ToString() const {
  return fmt::format("{:<8} {}", LogLevelName(level), BodyText());
}

}  // namespace runnel
