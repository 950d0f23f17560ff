#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel {

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
