#include "core/log/log_sink.h"

#include <utility>

#include <fmt/format.h>

#include "core/log/internal/log_dispatcher.h"

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

LogSink::LogSink(Runtime& runtime, Receive receive) {
  internal::LogDispatcher::OfProcess().Add(*this, runtime, std::move(receive));
}

LogSink::~LogSink() { internal::LogDispatcher::OfProcess().Remove(*this); }

void FlushLog() { internal::LogDispatcher::OfProcess().Flush(); }

}  // namespace runnel
