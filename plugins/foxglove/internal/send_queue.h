#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>

#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// Text messages on their way to a client that may be slow: none is lost, and they stay in order. The
/// caller makes no more of them while is_long().
class SendQueue {
 public:
  explicit SendQueue(WebClient& client) : client_(client) {}

  void Send(std::string message) {
    waiting_.push_back(std::move(message));
    Continue();
  }
  /// Whether all has gone out.
  bool Continue() {
    while (!waiting_.empty() && client_.SendText(waiting_.front())) waiting_.pop_front();
    return waiting_.empty();
  }
  [[nodiscard]] bool is_long() const noexcept { return waiting_.size() >= kLong; }
  [[nodiscard]] bool is_empty() const noexcept { return waiting_.empty(); }

 private:
  static constexpr std::size_t kLong = 100;

  WebClient& client_;
  std::deque<std::string> waiting_;
};

}  // namespace runnel::internal
