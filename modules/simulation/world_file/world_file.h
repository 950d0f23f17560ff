#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/result.h"
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
[[nodiscard]] std::optional<World> ReadWorldFile(const std::filesystem::path& path, Diagnostics& diagnostics);
/// `file_name` is what errors call the text.
[[nodiscard]] std::optional<World> ReadWorld(std::string_view text, std::string file_name, Diagnostics& diagnostics);

/// The world as XML in the format that ReadWorld reads. Numbers are as short as they can be without
/// losing a bit, so that reading gives an equal world. Headings of 0 and heights of 1 are left out.
[[nodiscard]] std::string WriteWorld(const World& world);

/// The folder of the XML files that come with Runnel: share/runnel/xml of the installation that this library belongs
/// to, or that of the sources from which it has been built.
[[nodiscard]] std::filesystem::path XmlFolder();

/// The names of the files in the folder that end in .xml, without that, sorted.
[[nodiscard]] std::vector<std::string> XmlNamesIn(const std::filesystem::path& folder);

/// The world file that people mean by `word`: a file, or else one of the worlds that come with Runnel, "rooms" or
/// "rooms.xml". A file without ending that is not in its folder ("apps/rooms") may mean one of these, too, since
/// names in application files are completed by their folder.
///
/// Threads: any. Allocates. Errors: neither, with the nearest name.
[[nodiscard]] Result<std::filesystem::path> FindWorldFile(const std::string& word);

}  // namespace runnel
