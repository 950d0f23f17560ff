#pragma once

#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/types/algorithm/drawing.h"
#include "modules/types/pose.h"

namespace runnel {

inline void Describe(TypeBuilder<DrawnKind>& type) {
  type.Name("DrawnKind").Values<DrawnKind::kPoints, DrawnKind::kLine, DrawnKind::kClosedLine, DrawnKind::kText>();
}

inline void Describe(TypeBuilder<DrawnColour>& type) {
  type.Name("DrawnColour").Fields<&DrawnColour::red, &DrawnColour::green, &DrawnColour::blue, &DrawnColour::alpha>();
}

inline void Describe(TypeBuilder<DrawnItem>& type) {
  type.Name("DrawnItem")
      .Field("kind", &DrawnItem::kind)
      .Field("points", &DrawnItem::points, {.unit = "m"})
      .Field("colour", &DrawnItem::colour)
      .Field("size", &DrawnItem::size, {.unit = "m"})
      .Field("text", &DrawnItem::text);
}

/// A module publishes one only while somebody looks, since it takes time and memory to make:
///
///     if (drawing.is_watched()) {
///       Drawing seen{.frame = "robot"};
///       seen.AddLine({{0, 0}, nearest}, {.red = 1});
///       drawing.Publish(std::move(seen));
///     }
inline void Describe(TypeBuilder<Drawing>& type) {
  type.Name("Drawing").SemanticTag("drawing").Fields<&Drawing::frame, &Drawing::items>();
}

inline void Describe(TypeBuilder<MapOutline>& type) {
  type.Name("MapOutline")
      .Fields<&MapOutline::points, &MapOutline::height>({.unit = "m"})
      .Field("is_hole", &MapOutline::is_hole, {.description = "within the outlines that come before it"});
}

inline void Describe(TypeBuilder<WorldMap>& type) {
  type.Name("WorldMap")
      .SemanticTag("world_map")
      .Fields<&WorldMap::name, &WorldMap::start, &WorldMap::goal, &WorldMap::outlines>()
      .Field("bounds", &WorldMap::bounds, {.unit = "m"});
}

}  // namespace runnel
