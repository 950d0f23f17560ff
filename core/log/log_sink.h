#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/base/clock.h"
#include "core/log/log_level.h"

namespace runnel {

class Runtime;

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

/// Reads what the elements of a runtime say, as long as it lives: a terminal, a file, a viewer, a recording.
///
/// One thread of the process, which the first sink starts and the last one ends, collects the messages of all
/// threads 20 times a second, and hands them on in the order of their times.
///
/// Ownership:  `receive` is called until the destructor returns, never by two threads at once. `runtime` outlives
///             this.
/// Errors:     `receive` shall not throw; one that does loses the message.
/// Threads:    any. `receive` must neither make nor destroy elements or sinks.
class LogSink {
 public:
  using Receive = std::function<void(const LogMessage&)>;

  LogSink(Runtime& runtime, Receive receive);
  /// Hands on what has been said before.
  ~LogSink();
  LogSink(const LogSink&) = delete;
  LogSink& operator=(const LogSink&) = delete;
};

/// Hands on at once what has been said so far. Any thread, but not within a cycle.
void FlushLog();

}  // namespace runnel
