#pragma once

#include <string>
#include <vector>

#include "plugins/application_files/path_use.h"
#include "plugins/application_files/xml_tag.h"

namespace runnel::internal {

/// Takes the part of the values that is meant off the path of a port: "x" off "world/pose.x".
[[nodiscard]] std::string TakePart(PathUse& use);
/// From the root, also if nothing is there.
[[nodiscard]] std::string AbsolutePath(const PathUse& use);

// Saving of <connect>.

void UpdateConnect(XmlElement tag, FrameworkElement& group, FileUpdate& update);
/// Of the connections that no tag says yet; those of one port together.
[[nodiscard]] std::vector<NewElement> MissingConnections(FrameworkElement& home, Saving& saving);

}  // namespace runnel::internal
