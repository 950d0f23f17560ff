#include "plugins/application_files/interface_direction.h"

namespace runnel {

bool IsRightWay(const Port& port, PathKind end, const Port& other) {
  if (!port.is_proxy() || &port == &other) return true;
  const FrameworkElement& group = *port.parent();
  const bool is_input = port.direction() == Port::Direction::kInput;
  // Of one group's input to its output inside, or back outside: either makes sense. Of two outputs
  // one is wrong, whichever; that is told at the first end.
  if (other.parent() == &group) {
    return end == PathKind::kInput || other.direction() != port.direction();
  }
  const bool is_inside = other.IsAtOrBelow(group);
  const bool receives = end == PathKind::kInput;
  return is_input == (is_inside != receives);
}

void CheckInterfaceDirection(const Port& port, const PathUse& use, PathKind end, const Port& other,
                             BuildContext& context) {
  if (IsRightWay(port, end, other)) return;
  if (!context.IsFirstFaultOf(port)) return;
  const bool is_input = port.direction() == Port::Direction::kInput;
  const std::string ways = is_input ? "an input of its group: it sends inside of the group and "
                                      "receives outside"
                                    : "an output of its group: it receives inside of the group and "
                                      "sends outside";
  context.Report({.message = "is " + ways,
                  .path = port.path(),
                  .hint = std::string("write direction=\"") + (is_input ? "output" : "input") +
                          "\" at its <port>, or swap 'from' and 'to'"},
                 use.position, use.base);
}

}  // namespace runnel
