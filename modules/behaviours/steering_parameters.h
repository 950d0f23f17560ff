#pragma once

#include "modules/behaviours/algorithm/steering.h"
#include "plugins/behaviours/behaviour.h"

namespace runnel {

/// The parameters that all driving behaviours have.
struct SteeringParameters {
  explicit SteeringParameters(Behaviour* behaviour)
      : speed(behaviour, "speed",
              {.default_value = SteeringConfiguration{}.speed,
               .bounds = {0.01, 10.0},
               .unit = "m/s",
               .description = "at most"}),
        turn_limit(behaviour, "turn_limit",
                   {.default_value = SteeringConfiguration{}.turn_limit,
                    .bounds = {0.05, 20.0},
                    .unit = "rad/s",
                    .description = "how fast it turns at most"}) {}

  Parameter<double> speed;
  Parameter<double> turn_limit;

  [[nodiscard]] SteeringConfiguration Get() const {
    SteeringConfiguration configuration;
    configuration.speed = speed.Get();
    configuration.turn_limit = turn_limit.Get();
    return configuration;
  }
};

}  // namespace runnel
