#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/element/annotation.h"
#include "core/port/port.h"
#include "core/port/port_stop.h"

namespace runnel {

class Runtime;

/// The module that has the port as its own; nullptr: none. Under the structure lock, as what follows.
[[nodiscard]] FrameworkElement* FindModuleOf(const Port& port);
/// Whether the module is a composite that makes the connection itself: not one that leads round it.
[[nodiscard]] bool IsWithinComposite(const FrameworkElement& module, const Port& from, const Port& to);
/// The inputs, or outputs, of the port's module, but for those by which its parameters are set.
void VisitSiblings(const Port& port, Port::Direction direction, const std::function<void(Port&)>& visit);

namespace internal {
/// Kept with a port: what Port::SetDriving() has said of it, which goes over to a port in its place; and what it had when another
/// one took its place, for the way back.
struct DrivingState final : Annotation {
  explicit DrivingState(std::shared_ptr<const DrivingMark> said) : mark(std::move(said)) {}
  static DrivingState& Of(Port& port) { return port.FindOrAnnotate<DrivingState>(nullptr); }
  static std::shared_ptr<const DrivingMark> MarkOf(const Port& port) {
    const auto* const found = port.FindAnnotation<DrivingState>();
    return found != nullptr ? found->mark : nullptr;
  }
  std::shared_ptr<const DrivingMark> mark;  // nullptr: nothing
  bool is_replaced = false;
  bool is_later = false, may_be_refused = false;  // it is to come back: what has been stopped meanwhile stays so
  std::shared_ptr<const PortStop> stop_before;
};

/// Errors: another port has its place now, as an output's while a recording is played.
[[nodiscard]] Result<void> CheckHasItsPlace(const Port& port);

/// What stops the velocities by which the robot moves that are made of what the port passes on. `held`: the ports where that
/// ends, as another value is set by hand there.
[[nodiscard]] std::vector<std::shared_ptr<const PortStop>> FindStopsOfVelocities(const Port& port,
                                                                                 std::vector<const Port*>& held);
}  // namespace internal

/// Kept with an output whose values come from elsewhere: how many write there now. Any thread.
struct WritersElsewhere final : Annotation {
  explicit WritersElsewhere(std::shared_ptr<const std::atomic<std::size_t>> of) : count(std::move(of)) {}
  const std::shared_ptr<const std::atomic<std::size_t>> count;
};

/// What the STOP of the robot holds, as paths with ", " between them; "": it holds nothing. Nothing while somebody else has
/// the structure lock, which is waited for some ms at most.
[[nodiscard]] std::optional<std::string> FindWhatDrives(Runtime& runtime);
/// Why a STOP that is in force stops nothing, with the cure.
[[nodiscard]] Error NothingDrives();

/// For what is told there, too, although it is no port of the tree: commands of motion that leave over a network. As long as
/// `stop` lives. Locks.
void AddWhatDrives(Runtime& runtime, std::string name, const std::shared_ptr<const PortStop>& stop);

}  // namespace runnel
