#pragma once

#include <string>
#include <string_view>

#include "core/base/clock.h"
#include "plugins/values/foxglove_channel.h"
#include "plugins/values/internal/value_view.h"

namespace runnel::internal {

/// When and where what is drawn is.
struct DrawnAt {
  Time timestamp;
  const FoxgloveOptions& options;
};

/// How values of types with a meaning are told in one of Foxglove's own schemas.
struct Drawing {
  std::string_view tag;     ///< the meaning
  std::string_view schema;  ///< without "foxglove."
  /// Whether the type has the fields that its meaning promises.
  bool (*fits)(const TypeInfo& type);
  void (*append)(const ValueView& value, const DrawnAt& at, std::string& json);
};

extern const Drawing kPoseDrawing, kTransformDrawing, kPathDrawing;
extern const Drawing kRangeScanDrawing, kImageDrawing;
extern const Drawing kPointDrawing, kHitAndLeavePointsDrawing, kDrawingDrawing, kWorldMapDrawing;

/// The JSON Schema of one of Foxglove's messages (github.com/foxglove/schemas), without the descriptions.
[[nodiscard]] std::string FoxgloveSchema(std::string_view name);

}  // namespace runnel::internal
