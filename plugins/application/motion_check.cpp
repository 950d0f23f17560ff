#include <string>

#include "core/element/source_place.h"
#include "core/port/port.h"
#include "core/port/port_stop.h"
#include "plugins/application/application_checks.h"

namespace runnel {

void WarnOfUnmarkedMotion(const ApplicationCheckUse& use) {
  const Port* moves = nullptr;
  bool is_marked = false;
  use.application.Visit([&](FrameworkElement& element) {
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr) return;
    is_marked = is_marked || port->is_driving();
    // What others read over the network is held by itself.
    const bool is_read = !port->is_proxy() && port->direction() == Port::Direction::kInput;
    if (moves == nullptr && is_read && IsVelocity(port->type(), port->unit())) moves = port;
  });
  if (moves == nullptr || is_marked) return;
  use.diagnostics.AddWarning({.message = "takes velocities, and no port of the application is marked as driving: a STOP stops nothing",
                              .path = moves->path(),
                              .position = FindSourcePlace(*moves),
                              .hint = "mark the port that moves something: <driving port=\"…\"/>"});
}

}  // namespace runnel
