#include "core/log/internal/log_dispatcher.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <new>

#include "core/element/element_path.h"
#include "core/element/framework_element.h"
#include "core/log/internal/encoded_message.h"
#include "core/log/internal/log_ring.h"

namespace runnel::internal {

namespace {

constexpr auto kEach = std::chrono::milliseconds(50);

}  // namespace

// Never destroyed: elements may outlive what is static.
LogDispatcher& LogDispatcher::OfProcess() {
  static auto& dispatcher = *new LogDispatcher;
  return dispatcher;
}

void LogDispatcher::Add(Logger& logger) {
  const std::lock_guard lock(listing_);
  logger.next_ = std::exchange(first_, &logger);
  if (logger.next_ != nullptr) logger.next_->previous_ = &logger;
  logger.lowest_.store(LowestFor(logger), std::memory_order_relaxed);
}

void LogDispatcher::Remove(Logger& logger, bool has_spoken) noexcept {
  if (has_spoken) Flush();
  const std::lock_guard lock(listing_);
  if (logger.next_ != nullptr) logger.next_->previous_ = logger.previous_;
  (logger.previous_ != nullptr ? logger.previous_->next_ : first_) = logger.next_;
}

void LogDispatcher::Add(const LogSink& sink, Runtime& runtime, std::function<void(const LogMessage&)> receive) {
  const std::lock_guard lock(reading_);
  sinks_.push_back({&sink, &runtime, std::move(receive)});
  if (thread_.joinable()) return;
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
  } catch (...) {
    sinks_.pop_back();
    throw;
  }
}

void LogDispatcher::Remove(const LogSink& sink) noexcept {
  std::jthread ended;
  const std::lock_guard lock(reading_);
  HandOn();
  std::erase_if(sinks_, [&](const Sink& each) { return each.owner == &sink; });
  if (sinks_.empty()) ended = std::exchange(thread_, {});
  ended.request_stop();
}

void LogDispatcher::Run(const std::stop_token& stop) {
  std::unique_lock lock(reading_);
  while (!stop.stop_requested()) {
    HandOn();
    wake_.wait_for(lock, stop, kEach, [] { return false; });
  }
}

void LogDispatcher::Flush() {
  const std::lock_guard lock(reading_);
  HandOn();
}

void LogDispatcher::HandOn() noexcept {
  try {
    for (const Pending& pending : Collect()) Show(pending);
  } catch (const std::bad_alloc&) {
    ++lost_;  // at least
  }
}

void LogDispatcher::Show(const Pending& pending) {
  for (const Sink& sink : sinks_) {
    if (pending.runtime != nullptr && sink.runtime != pending.runtime) continue;
    try {
      sink.receive(pending.message);
    } catch (const std::exception&) {  // as the header says: the message is lost to this sink
    }
  }
}

std::vector<LogDispatcher::Pending> LogDispatcher::Collect() {
  std::vector<Pending> messages;
  LogRing::ForEach([&](LogRing& ring) {
    EncodedMessage::Header header;
    while (ring.Pop(&header, sizeof header)) {
      std::array<std::byte, EncodedMessage::kMostBytes> rest;
      (void)ring.Pop(rest.data(), header.size - sizeof header);
      const FrameworkElement& element = header.source->element();
      messages.push_back({&element.runtime(),
                          {.time = Time(Duration(header.time)),
                           .level = header.level,
                           .path = element.path(),
                           .text = EncodedMessage::TextOf(header, rest.data()),
                           .left_out = header.left_out}});
    }
    lost_ += ring.TakeLost();
  });
  std::ranges::stable_sort(messages, {}, [](const Pending& each) { return each.message.time; });
  if (lost_ > 0) {
    messages.push_back({nullptr,
                        {.time = messages.empty() ? Time{} : messages.back().message.time,
                         .level = LogLevel::kWarning,
                         .path = {},
                         .text = std::to_string(lost_) + " messages were lost: the log is read too slowly"}});
    lost_ = 0;
  }
  return messages;
}

void LogDispatcher::SetLevel(Runtime& runtime, std::string path, LogLevel level) {
  const std::lock_guard lock(listing_);
  levels_[&runtime].insert_or_assign(std::move(path), level);
  SetAll(runtime);
}

bool LogDispatcher::ResetLevel(Runtime& runtime, const std::string& path) {
  const std::lock_guard lock(listing_);
  const auto found = levels_.find(&runtime);
  if (found == levels_.end() || found->second.erase(path) == 0) return false;
  SetAll(runtime);
  return true;
}

LogLevels LogDispatcher::Levels(const Runtime& runtime) {
  const std::lock_guard lock(listing_);
  const auto found = levels_.find(&runtime);
  if (found == levels_.end()) return {};
  return {found->second.begin(), found->second.end()};
}

void LogDispatcher::ForgetLevels(const Runtime& runtime) noexcept {
  const std::lock_guard lock(listing_);
  levels_.erase(&runtime);
}

void LogDispatcher::SetAll(const Runtime& runtime) noexcept {
  for (Logger* logger = first_; logger != nullptr; logger = logger->next_) {
    if (&logger->element_.runtime() != &runtime) continue;
    // relaxed: see Logger::Wants().
    logger->lowest_.store(LowestFor(*logger), std::memory_order_relaxed);
  }
}

LogLevel LogDispatcher::LowestFor(const Logger& logger) const {
  const auto found = levels_.find(&logger.element_.runtime());
  if (found == levels_.end()) return LogLevel::kInfo;
  LogLevel lowest = LogLevel::kInfo;
  // In their order a path comes before those below it.
  for (const auto& [path, level] : found->second) {
    if (IsAtOrBelow(logger.element_.path(), path)) lowest = level;
  }
  return lowest;
}

}  // namespace runnel::internal
