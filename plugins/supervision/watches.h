#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/element/runtime.h"
#include "core/port/port.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/supervision/supervision_rules.h"

namespace runnel {

/// Does several things, of which none keeps up another.
class EachForItself {
 public:
  template <typename Part>
  void Do(const Part& part) noexcept {
    try {
      part();
    } catch (...) {
      failure_ = std::current_exception();
    }
  }
  /// Throws what one of them has thrown.
  void End() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::exception_ptr failure_;
};

}  // namespace runnel

namespace runnel::internal {

/// Follows one rule of silence through time.
///
/// Threads: one at a time.
class StaleWatch {
 public:
  enum class Turn { kNone, kStale, kFresh };

  StaleWatch(std::shared_ptr<const SupervisionRule> rule, std::vector<std::string> outputs)
      : rule_(std::move(rule)), outputs_(std::move(outputs)) {}

  /// Under the structure lock.
  [[nodiscard]] std::vector<std::string>& outputs() noexcept { return outputs_; }

  /// Looks at the outputs; says if the input has become stale or fresh, again and again until somebody has done what that
  /// asks for. Under the structure lock, both.
  [[nodiscard]] Turn Look(Runtime& runtime, Time now);
  void NoteDone(Turn turn, Time now) noexcept;
  /// When it need be looked at again.
  [[nodiscard]] Time next_look() const noexcept { return next_look_; }
  /// Whether the input is stale, and not fresh again yet, as of the last look.
  [[nodiscard]] bool is_stale() const noexcept { return is_stale_; }
  /// Since when nothing has come, as of the last look.
  [[nodiscard]] Time silent_since() const noexcept { return heard_.value_or(Time{}); }

 private:
  void Hear(Runtime& runtime);
  [[nodiscard]] Turn Judge(bool is_silent);

  const std::shared_ptr<const SupervisionRule> rule_;
  std::vector<std::string> outputs_;  // by path: modules may be replaced meanwhile
  std::optional<Time> heard_;         // the newest timestamp, or the first look
  std::optional<Time> well_since_;    // while stale: since when values come again
  bool is_stale_ = false;
  Turn pending_ = Turn::kNone;  // what has been said, and not been done
  Time next_look_{};
};

/// What a port gets its values by: all whose silence nobody notices, since a module on the way does not look how old it is
/// what they say, or they set a parameter there.
///
/// Threads: all under the structure lock. It is of one revision of the structure.
class Feeding {
 public:
  Feeding(Port& port, Time now);
  /// "": all that feed it run, and have published since they were at rest.
  [[nodiscard]] std::string WhyAtRest(const Scheduler& scheduler, Time now) const;
  [[nodiscard]] const std::vector<Port*>& sources() const noexcept { return sources_; }

 private:
  void LookUpstream(const Port& input, bool times_out);
  void LookAtParameters(const Port& of);
  [[nodiscard]] bool LookAtCut(FrameworkElement& element, bool is_fed) const;

  const Port& port_;
  const Time at_;
  const std::vector<Port*> sources_;
  std::vector<Port*> upstream_;                      // outputs that it moves by; the sources, too
  std::vector<const Port*> cut_off_;                 // inputs on the way that something was connected to
  std::vector<const FrameworkElement*> parameters_;  // those that something set
  std::set<std::pair<const Port*, bool>> seen_;
};

/// Has ports that drive read their safe value while a module that feeds them does not run: it is paused, has failed, or its
/// thread is stuck. By the slot of rules, and until the module has published again. Feeding says who counts. Modules
/// that drive and wait for data are run without, since what grows old does not come. What is sent to others who move by it,
/// as a command over a network is, is held where it leaves the tree. Tells where the module that drives does not run itself,
/// so that neither this nor a STOP reaches it.
///
/// Threads: all under the structure lock.
class Standstill {
 public:
  using Tell = std::function<void(const Port& port, std::string what, bool is_recovery)>;

  /// Costs little while the structure stays as it is.
  void Look(Runtime& runtime, const Scheduler& scheduler, Time now, const Tell& tell);
  /// A rule has set the port's value; it is the rule's to take it back.
  static void LeaveToRule(Port& port);
  /// A rule takes its value back. Whether the port drives and what feeds it does not run yet: it has its safe value from now
  /// on, until that has published again.
  [[nodiscard]] static bool TakesOver(Port& port, const Scheduler& scheduler, Time now);

 private:
  struct Driven {
    Port* port;
    std::vector<Port*> sinks;
    Feeding feeding;
    bool drives;
  };
  static void LookAtReaders(const Driven& driven, const Scheduler& scheduler, const Tell& tell);
  static void LookAtSources(const Driven& driven, const Scheduler& scheduler, Time now, const Tell& tell);

  std::vector<Driven> driven_;  // as of the structure's revision
  std::vector<Port*> outputs_;  // likewise
  std::uint64_t revision_ = ~std::uint64_t{};
};

}  // namespace runnel::internal
