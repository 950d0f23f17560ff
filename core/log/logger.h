#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>

#include <fmt/core.h>

#include "core/base/clock.h"
#include "core/log/internal/encoded_message.h"
#include "core/log/log_level.h"

namespace runnel {

class FrameworkElement;

namespace internal {
class LogDispatcher;
class LogRing;
// initial-exec: one load instead of a call, also from plugins.
extern thread_local constinit LogRing* log_ring __attribute__((tls_model("initial-exec")));
void TakeLogRing() noexcept;
}  // namespace internal

/// What an element says to people while it runs:
///
///     log().Warn("no echo for {} s", seconds);
///
/// The format is fmt's, checked when it is compiled; arguments are numbers, characters, truth values and texts.
/// They are copied as they are into a ring of the calling thread, and formatted by whoever reads the log (LogSink).
///
/// Rate:        at most 20 messages of a level at once, and 10 a second of the application's time on average;
///              what is more is left out, and counted with the next one.
/// Threads:     any, also several at once.
/// Progress:    wait-free. What finds no room in the ring is lost, and counted; so is what
///              other threads keep from its token four times in a row.
/// Allocation:  none, but in the first call of a thread (PrepareLogging()); no lock, no system call in a cycle.
/// Ownership:   belongs to its element. When it goes, what it has said is handed on first.
class Logger {
 public:
  /// `element` outlives this.
  explicit Logger(const FrameworkElement& element);
  ~Logger();
  Logger(const Logger&) = delete;
  Logger& operator=(const Logger&) = delete;

  template <typename... Arguments>
  void Debug(fmt::format_string<Arguments...> format, const Arguments&... arguments) noexcept {
    Write(LogLevel::kDebug, format, arguments...);
  }
  template <typename... Arguments>
  void Info(fmt::format_string<Arguments...> format, const Arguments&... arguments) noexcept {
    Write(LogLevel::kInfo, format, arguments...);
  }
  template <typename... Arguments>
  void Warn(fmt::format_string<Arguments...> format, const Arguments&... arguments) noexcept {
    Write(LogLevel::kWarning, format, arguments...);
  }
  template <typename... Arguments>
  void Error(fmt::format_string<Arguments...> format, const Arguments&... arguments) noexcept {
    Write(LogLevel::kError, format, arguments...);
  }

  /// Whether what is said at this level is read: ask before working out what is seldom wanted.
  [[nodiscard]] bool Wants(LogLevel level) const noexcept {
    // relaxed: a level that is seen late lets one message more or less through.
    return level >= lowest_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] const FrameworkElement& element() const noexcept { return element_; }

 private:
  friend class internal::LogDispatcher;

  template <typename... Arguments>
  void Write(LogLevel level, fmt::string_view format, const Arguments&... arguments) noexcept {
    static_assert((internal::IsLoggable<Arguments> && ...),
                  "a log takes numbers, characters, truth values and texts: say which part of the value is meant");
    if (!Wants(level)) return;
    internal::EncodedMessage message({format.data(), format.size()});
    (message.Add(arguments), ...);
    Send(level, message);
  }
  void Send(LogLevel level, internal::EncodedMessage& message) noexcept;

  /// Lets messages through as long as it has tokens. It is one word, the time at which it will be full again (the
  /// generic cell rate algorithm), so that several threads may take tokens at once: each takes one by one exchange.
  class TokenBucket {
   public:
    [[nodiscard]] bool Take(Time now) noexcept;

    std::atomic<std::uint64_t> left_out{0};

   private:
    static constexpr std::int64_t kInterval = 100'000'000;  // ns for one token
    static constexpr std::int64_t kCapacity = 20 * kInterval;
    static constexpr int kMostTries = 4;

    std::atomic<std::int64_t> full_at_{std::numeric_limits<std::int64_t>::min()};  // ns
  };

  const FrameworkElement& element_;
  std::atomic<LogLevel> lowest_{LogLevel::kInfo};
  std::atomic<bool> has_spoken_{false};
  std::array<TokenBucket, 4> buckets_;
  // In the dispatcher's list of all; its business alone.
  Logger* previous_ = nullptr;
  Logger* next_ = nullptr;
};

/// Makes the calling thread's ring, so that the first message of a cycle need not. Executors call it when a thread
/// begins.
inline void PrepareLogging() noexcept {
  if (internal::log_ring == nullptr) [[unlikely]]
    internal::TakeLogRing();
}

}  // namespace runnel
