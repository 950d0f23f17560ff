#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/diagnostics.h"
#include "modules/simulation/algorithm/world.h"

namespace runnel {

/// Reads a world from XML. The format, in m and rad:
///
///     <world name="cup">
///       <start x="-6" y="0.4" heading="0"/>  <goal x="7" y="0.4"/>
///       <polygon> <point x="1" y="1"/> … <hole> <point …/> … </hole> </polygon>
///       <box x="0" y="0" heading="0" length="2" width="1"/>  <cylinder x="0" y="0" radius="1"/>
///       <wall thickness="0.1"> <point …/> <point …/> … </wall>
///       <bounds> <point …/> … </bounds>
///     </world>
///
/// One start, one goal, at most one bounds, any number of the others in any order. A heading may be
/// missing (0), and so may the height of an obstacle (1). Rings may turn either way.
///
/// Errors: all that is wrong with the file is added to `diagnostics` at once, each with its place;
/// then there is no world. That includes bad geometry (FaultsOf); a goal that cannot be reached is
/// allowed.
[[nodiscard]] std::optional<World> ReadWorldFile(const std::filesystem::path& path,
                                                 Diagnostics& diagnostics);
/// `file_name` is what errors call the text.
[[nodiscard]] std::optional<World> ReadWorld(std::string_view text, std::string file_name,
                                             Diagnostics& diagnostics);

}  // namespace runnel
