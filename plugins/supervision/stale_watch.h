#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/element/runtime.h"
#include "plugins/supervision/supervision_rules.h"

namespace runnel::internal {

/// Follows one rule of silence through time.
///
/// Threads: one at a time.
class StaleWatch {
 public:
  enum class Turn { kNone, kStale, kFresh };

  StaleWatch(std::shared_ptr<const SupervisionRule> rule, std::vector<std::string> outputs)
      : rule_(std::move(rule)), outputs_(std::move(outputs)) {}

  /// Under the structure lock, as the next one.
  [[nodiscard]] const SupervisionRule& rule() const noexcept { return *rule_; }
  [[nodiscard]] std::vector<std::string>& outputs() noexcept { return outputs_; }

  /// Looks at the outputs; says if the input has become stale or fresh. Under the structure lock.
  [[nodiscard]] Turn Look(Runtime& runtime, Time now);
  /// When it need be looked at again.
  [[nodiscard]] Time next_look() const noexcept { return next_look_; }
  /// Since when nothing has come, as of the last look.
  [[nodiscard]] Time silent_since() const noexcept { return heard_.value_or(Time{}); }

 private:
  void Hear(Runtime& runtime);
  [[nodiscard]] Turn Judge(Time now);

  const std::shared_ptr<const SupervisionRule> rule_;
  std::vector<std::string> outputs_;  // by path: modules may be replaced meanwhile
  std::optional<Time> heard_;               // the newest timestamp, or the first look
  std::optional<Time> well_since_;          // while stale: since when values come again
  bool is_stale_ = false;
  Time next_look_{};
};

}  // namespace runnel::internal
