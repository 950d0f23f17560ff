#pragma once

#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

inline void Describe(TypeBuilder<Point2>& type) {
  type.Name("Point2").SemanticTag("point").Fields<&Point2::x, &Point2::y>({.unit = "m"});
}

inline void Describe(TypeBuilder<Pose2>& type) {
  type.Name("Pose2")
      .SemanticTag("pose")
      .Fields<&Pose2::x, &Pose2::y>({.unit = "m"})
      .Field("heading", &Pose2::heading, {.unit = "rad"});
}

inline void Describe(TypeBuilder<Twist2>& type) {
  type.Name("Twist2")
      .SemanticTag("twist")
      .Field("forward", &Twist2::forward, {.unit = "m/s"})
      .Field("turn", &Twist2::turn, {.unit = "rad/s"});
}

inline void Describe(TypeBuilder<WheelSpeeds>& type) {
  type.Name("WheelSpeeds").Fields<&WheelSpeeds::left, &WheelSpeeds::right>({.unit = "rad/s"});
}

inline void Describe(TypeBuilder<Path2>& type) {
  type.Name("Path2").SemanticTag("path").Field("points", &Path2::points, {.unit = "m"});
}

}  // namespace runnel
