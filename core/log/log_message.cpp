#include "core/log/log_message.h"

#include <fmt/format.h>

namespace runnel {

std::string LogMessage::TextWithCount() const {
  return left_out > 0 ? fmt::format("{} ({} more left out)", text, left_out) : text;
}

std::string LogMessage::BodyText() const {
  return fmt::format("{}{}{}", path, path.empty() ? "" : ": ", TextWithCount());
}

std::string LogMessage::ToString() const {
  return fmt::format("{:<8} {}", LogLevelName(level), BodyText());
}

}  // namespace runnel
