#include "plugins/values/foxglove_log.h"

#include "core/log/log_sink.h"
#include "plugins/values/internal/drawing.h"
#include "plugins/values/internal/message_parts.h"

namespace runnel {

namespace {

// By the numbers of foxglove.LogLevel, of which 5 is fatal.
int NumberOf(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return 1;
    case LogLevel::kInfo:
      return 2;
    case LogLevel::kWarning:
      return 3;
    case LogLevel::kError:
      return 4;
    case LogLevel::kOff:
      break;
  }
  return 0;
}

// Where in a source it was said is not known.
void Append(const LogMessage& said, Time timestamp, std::string& json) {
  JsonObject message(json);
  internal::AppendTime(timestamp, message.Key("timestamp"));
  message.Add("level", NumberOf(said.level)).Add("message", said.TextWithCount());
  message.Add("name", said.path).Add("file", "").Add("line", 0);
}

}  // namespace

FoxgloveChannel LogChannel() {
  return {"/log", "foxglove.Log", internal::FoxgloveSchema("Log"),
          [](const void* value, Time timestamp, std::string& json) {
            Append(*static_cast<const LogMessage*>(value), timestamp, json);
          }};
}

}  // namespace runnel
