#include "core/log/logger.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/element/runtime.h"
#include "core/log/internal/log_dispatcher.h"
#include "core/log/internal/log_ring.h"
#include "core/log/log_sink.h"
#include "core/port/cycle.h"

namespace runnel {

Logger::Logger(const FrameworkElement& element) : element_(element) { internal::LogDispatcher::OfProcess().Add(*this); }

Logger::~Logger() {
  // relaxed: whoever has written has ended before the element is destroyed.
  internal::LogDispatcher::OfProcess().Remove(*this, has_spoken_.load(std::memory_order_relaxed));
}

void Logger::Send(LogLevel level, internal::EncodedMessage& message) noexcept {
  const Cycle* const cycle = CurrentCycle();
  const Time now = cycle != nullptr ? cycle->now : element_.runtime().clock().Now();
  TokenBucket& bucket = buckets_.at(static_cast<std::size_t>(level));
  if (!bucket.Take(now)) {
    // relaxed: a count, read by no order.
    bucket.left_out.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  PrepareLogging();
  internal::LogRing* const ring = internal::log_ring;
  if (ring == nullptr) return;  // no memory for it
  auto& header = message.header();
  header.source = this;
  header.time = now.time_since_epoch().count();
  header.level = level;
  header.left_out = bucket.left_out.exchange(0, std::memory_order_relaxed);
  // relaxed: read when no other thread writes any more.
  has_spoken_.store(true, std::memory_order_relaxed);
  ring->Push(message.Finish(), message.size());
}

bool Logger::TokenBucket::Take(Time now) noexcept {
  const std::int64_t at = now.time_since_epoch().count();
  // relaxed throughout: the word says all, nothing else is read by it.
  std::int64_t full_at = full_at_.load(std::memory_order_relaxed);
  for (int tries = 0; tries < kMostTries; ++tries) {
    const std::int64_t from = std::max(full_at, at);
    const bool has_token = from - at <= kCapacity - kInterval;
    // Further away than an empty bucket's: the clock has been set back. That fills nothing, and stops nothing.
    const std::int64_t next = has_token ? from + kInterval : std::min(from, at + kCapacity);
    if (next == full_at) return false;
    if (full_at_.compare_exchange_strong(full_at, next, std::memory_order_relaxed)) return has_token;
  }
  return false;
}

std::string LogMessage::TextWithCount() const {
  return left_out > 0 ? fmt::format("{} ({} more left out)", text, left_out) : text;
}

std::string LogMessage::BodyText() const {
  return fmt::format("{}{}{}", path, path.empty() ? "" : ": ", TextWithCount());
}

std::string LogMessage::ToString() const { return fmt::format("{:<8} {}", LogLevelName(level), BodyText()); }

LogSink::LogSink(Runtime& runtime, Receive receive) {
  internal::LogDispatcher::OfProcess().Add(*this, runtime, std::move(receive));
}

LogSink::~LogSink() { internal::LogDispatcher::OfProcess().Remove(*this); }

void FlushLog() { internal::LogDispatcher::OfProcess().Flush(); }

}  // namespace runnel
