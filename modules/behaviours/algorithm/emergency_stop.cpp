#include "modules/behaviours/algorithm/emergency_stop.h"

namespace runnel {

Wish EmergencyStop(const EmergencyStopConfiguration& configuration, const Surroundings& surroundings,
                   const Twist2& wanted) {
  const double free = FreeRange(surroundings, 0.0, PassingRadius(surroundings));
  const bool is_too_near = free < configuration.least_way && wanted.forward > 0.0;
  return {{0.0, wanted.turn}, is_too_near ? 1.0 : 0.0};
}

}  // namespace runnel
