#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/element/configurable.h"
#include "core/element/runtime.h"
#include "core/port/port.h"

namespace runnel::internal {

/// Elements that clients have brought with them are annotated so: they are not shown to clients.
class BroughtByClient final : public Annotation {};

struct FoundPort {
  std::string path;
  std::string topic;
  const TypeInfo* type;
  bool is_shown;                     ///< values come out of it
  bool is_target;                    ///< values can be put into it
  std::string owner;                 ///< path of the module or group
  std::vector<std::string> readers;  ///< paths of the modules that read what comes out, sorted
};

struct FoundParameter {
  std::string path;
  std::string topic;
  const TypeInfo* type;
  const Configurable* element;
};

/// What of a structure can be shown, as it was at one moment.
struct FoundStructure {
  static constexpr std::size_t kNone = ~std::size_t{0};

  std::uint64_t revision = 0;
  std::vector<FoundPort> ports;  ///< in the order of the tree
  std::vector<FoundParameter> parameters;
  std::size_t robot_pose = kNone;  ///< which of the ports tells where the robot is
};

/// Under the structure lock.
[[nodiscard]] FoundStructure FindStructure(Runtime& runtime);

}  // namespace runnel::internal
