#pragma once

#include <functional>
#include <string>

#include "core/paths/distant_ports.h"

namespace runnel {

class DiscoveryTable;

/// Of "//camera_box/camera/image", by what its writers say. `expected`: taken for it if one of them fits it; optional.
/// `know_types` makes more types known, if there are any; under the structure lock if that calls for it.
[[nodiscard]] DistantType FindDistantType(const DiscoveryTable& table, const std::string& path, const TypeInfo* expected,
                                          const std::function<void()>& know_types);

/// What is said on the wire of plain numbers: "runnel_unit=deg;"; "" of others.
[[nodiscard]] std::string UnitText(const std::string& unit);

}  // namespace runnel
