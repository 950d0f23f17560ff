#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/runtime.h"
#include "core/port/port.h"
#include "core/port/port_stop.h"

namespace runnel {

/// How many values have passed a port, and when the newest of them was published.
struct Publications {
  std::uint64_t count = 0;
  std::optional<Time> newest = {};
  /// Under the structure lock.
  [[nodiscard]] static Publications Of(const Port& port);
};

/// Publications a second, by the times between them and not between the looks: 5 Hz are 5 Hz, however often somebody
/// looks.
///
/// Threads:  one at a time.
class PublicationRate {
 public:
  /// Of what has come since the look before. 0 until two publications are known, and when none has come for longer than
  /// two periods. `time`: now, by the application's clock.
  double Look(const Publications& publications, Time time);

 private:
  Publications last_;
  double rate_ = 0;
};

class InputBase;

/// Shows what readers of the port find now: what is published, or the safe value while it is stopped. False: nothing.
/// Under the structure lock.
bool VisitShown(const Port& port, const Port::Visitor& look);

/// A port that somebody looks at now and then, by its path: modules may come and go meanwhile.
/// Publishers do not notice; nothing is subscribed or copied.
///
///     const EpochGuard guard;  // what is found stays in memory so long
///     {
///       const std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
///       if (!lock || !watched.Find(runtime)) return;
///     }
///     watched.VisitIfNew([&](const void* value, Time timestamp) { … });
///
/// Threads:  one at a time.
class WatchedPort {
 public:
  explicit WatchedPort(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  /// Under the structure lock, and within an EpochGuard that lasts until after VisitIfNew().
  /// Errors: there is no such port (any more), with the nearest name.
  Result<void> Find(Runtime& runtime);
  /// The one that was found. Under the same lock as Find().
  [[nodiscard]] const Port& port() const noexcept { return *port_; }
  /// Of the port that was found.
  [[nodiscard]] const TypeInfo& type() const noexcept { return *type_; }

  /// Shows what readers find there now, unless it has been shown already; returns how many values have been published so
  /// far. `look` is called again, for a newer one, if something is published meanwhile. Of a group's interface port: the first that there is among its sources'. Not under the
  /// structure lock.
  std::optional<std::uint64_t> VisitIfNew(const Port::Visitor& look);
  /// How many values the queue of the port that was found has lost, if it is an input with one; else 0.
  /// Where VisitIfNew() may be called.
  [[nodiscard]] std::uint64_t dropped() const noexcept;

 private:
  const std::string path_;
  std::vector<const Port*> sources_;
  const Port* port_ = nullptr;
  const InputBase* input_ = nullptr;  // the port that was found, if it is one
  const TypeInfo* type_ = nullptr;
  std::vector<std::uint64_t> ids_;  // of the port that was found last, and of those whose values it showed
  std::vector<internal::PassedStop> stops_;
  const Clock* clock_ = nullptr;
  std::optional<std::pair<std::uint64_t, std::int64_t>> shown_;  // how many, and what let them pass
};

}  // namespace runnel
