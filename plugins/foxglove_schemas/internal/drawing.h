#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/base/clock.h"
#include "plugins/foxglove_schemas/foxglove_channel.h"

namespace runnel::internal {

/// How values of a type with a meaning are told in one of Foxglove's own schemas.
struct Drawing {
  std::string schema_name;
  std::string schema;
  std::function<void(const void* value, Time timestamp, std::string& json)> append;
};

/// Each: nothing, if the type has not the fields that its meaning promises.
[[nodiscard]] std::optional<Drawing> DrawPose(const TypeInfo& type, const FoxgloveOptions& options);
[[nodiscard]] std::optional<Drawing> DrawTransform(const TypeInfo& type,
                                                   const FoxgloveOptions& options);
[[nodiscard]] std::optional<Drawing> DrawPath(const TypeInfo& type, const FoxgloveOptions& options);
[[nodiscard]] std::optional<Drawing> DrawRangeScan(const TypeInfo& type,
                                                   const FoxgloveOptions& options);
[[nodiscard]] std::optional<Drawing> DrawImage(const TypeInfo& type,
                                               const FoxgloveOptions& options);
[[nodiscard]] std::optional<Drawing> DrawPoint(const TypeInfo& type,
                                               const FoxgloveOptions& options);
[[nodiscard]] std::optional<Drawing> DrawHitAndLeavePoints(const TypeInfo& type,
                                                           const FoxgloveOptions& options);
[[nodiscard]] std::optional<Drawing> DrawWorldMap(const TypeInfo& type,
                                                  const FoxgloveOptions& options);

}  // namespace runnel::internal
