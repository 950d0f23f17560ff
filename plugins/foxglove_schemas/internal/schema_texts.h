#pragma once

#include <string>

namespace runnel::internal {

/// JSON Schemas of Foxglove's messages (github.com/foxglove/schemas), without the descriptions.
[[nodiscard]] std::string PoseInFrameSchema();
[[nodiscard]] std::string PosesInFrameSchema();
[[nodiscard]] std::string LaserScanSchema();
[[nodiscard]] std::string RawImageSchema();
[[nodiscard]] std::string FrameTransformSchema();
[[nodiscard]] std::string SceneUpdateSchema();

}  // namespace runnel::internal
