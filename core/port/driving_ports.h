#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/port/port.h"
#include "core/port/port_stop.h"

namespace runnel {

class Runtime;

/// The inputs, or outputs, of the port's module that have its type: a filter, gate or merge passes on from them, or to them.
/// Under the structure lock.
void VisitPassing(const Port& port, Port::Direction direction, const std::function<void(Port&)>& visit);

/// The inputs by which outputs set parameters of the port's module (Configurable::Feed()). Under the structure lock.
void VisitFeeds(const Port& port, const std::function<void(Port& feed)>& visit);

/// What the STOP of the robot holds, as paths with ", " between them; "": it holds nothing. Nothing while somebody else has
/// the structure lock, which is waited for some ms at most.
[[nodiscard]] std::optional<std::string> FindWhatDrives(Runtime& runtime);
/// Why a STOP that is in force stops nothing, with the cure.
[[nodiscard]] Error NothingDrives();

/// For what is told there, too, although it is no port of the tree: commands of motion that leave over a network. As long as
/// `stop` lives. Locks.
void AddWhatDrives(Runtime& runtime, std::string name, const std::shared_ptr<const PortStop>& stop);

}  // namespace runnel
