#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/element/runtime.h"
#include "core/port/port.h"

namespace runnel {

class InputBase;

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

  /// Shows the newest value, unless it has been shown already; returns how many have been published so
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
  std::optional<std::uint64_t> shown_;
};

}  // namespace runnel
