#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "plugins/ros_messages/node_messages.h"
#include "plugins/wire/wire.h"

namespace runnel {

/// How an application is, told on /diagnostics once a second of its time, and at once when it has got better or worse.
///
/// Threads: one at a time.
class DiagnosticsTopic {
 public:
  /// Called several times a second, while somebody listens. Not under the structure lock.
  using Health = std::function<std::vector<RosDiagnosticStatus>()>;

  /// `clock`: the application's. Errors: of the engine.
  static Result<std::unique_ptr<DiagnosticsTopic>> Start(WireParticipant& participant, const Clock& clock, bool is_simulated,
                                                         Health health, std::function<void()> on_news);

  /// Tells what is due. When it wants to be called again, by the steady clock; nothing: when there are news.
  std::optional<Time> Send(Time now);
  [[nodiscard]] const WireId& id() const noexcept { return writer_->id(); }

 private:
  DiagnosticsTopic(const Clock& clock, bool is_simulated, Health health)
      : clock_(clock), is_simulated_(is_simulated), health_(std::move(health)) {}

  const Clock& clock_;
  const bool is_simulated_;
  const Health health_;
  std::shared_ptr<std::atomic<std::size_t>> listeners_ = std::make_shared<std::atomic<std::size_t>>(0);
  std::vector<RosHealth> told_;
  std::optional<Time> told_at_;  // of the application
  std::unique_ptr<WireWriter> writer_;
};

}  // namespace runnel
