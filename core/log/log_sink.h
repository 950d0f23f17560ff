#pragma once

#include <functional>

#include "core/log/log_message.h"

namespace runnel {

class Runtime;

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
