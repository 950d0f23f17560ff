#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/log/log_level.h"
#include "core/log/log_sink.h"
#include "core/log/logger.h"
#include "core/port/cycle.h"

namespace runnel::test {

class Speaker final : public FrameworkElement {
 public:
  explicit Speaker(const Placement& placement) : FrameworkElement(placement, ElementKind::kModule) {}
  Logger log{*this};
};

/// Keeps what a runtime's elements have said.
class Listener {
 public:
  explicit Listener(Runtime& runtime)
      : sink_(runtime, [this](const LogMessage& message) {
          const std::lock_guard lock(mutex_);
          messages_.push_back(message);
        }) {}

  [[nodiscard]] std::vector<LogMessage> messages() {
    FlushLog();
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  [[nodiscard]] std::vector<std::string> lines() {
    std::vector<std::string> lines;
    for (const LogMessage& message : messages()) lines.push_back(message.ToString());
    return lines;
  }

 private:
  std::mutex mutex_;
  std::vector<LogMessage> messages_;
  LogSink sink_;  // the last: nothing comes after it
};

}  // namespace runnel::test
