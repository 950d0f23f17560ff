#pragma once

#include <string>
#include <vector>

#include "core/paths/path_search.h"
#include "core/xml/xml_document.h"
#include "plugins/application_files/build_context.h"

namespace runnel {

/// A path to an element, as it stands in an application file.
struct PathUse {
  FrameworkElement& base;  ///< where relative paths begin
  std::string path;
  SourcePosition position;
};

/// The one path in an attribute.
[[nodiscard]] PathUse PathIn(const XmlAttribute& attribute, FrameworkElement& base);
/// The paths in an attribute that holds a list, each with its own place.
[[nodiscard]] std::vector<PathUse> PathsIn(const XmlAttribute& attribute, FrameworkElement& base);

// What a path names, or nullptr after reporting what is not there or is something else.

[[nodiscard]] FrameworkElement* SearchElement(const PathUse& use, BuildContext& context,
                                              PathKind kind = PathKind::kElement);
[[nodiscard]] Port* SearchPort(const PathUse& use, PathKind kind, BuildContext& context);
/// What can be set while the application runs, and would take `value`.
[[nodiscard]] FrameworkElement* SearchSettable(const XmlAttribute& path, const XmlAttribute& value,
                                               FrameworkElement& base, BuildContext& context);

/// The port, without reporting.
[[nodiscard]] Port* FindPort(const PathUse& use, PathKind kind);

/// Whether `port`, as the `end` of a connection with `other`, is used as its direction says; true for
/// ports that are no interface ports.
[[nodiscard]] bool IsRightWay(const Port& port, PathKind end, const Port& other);

/// Whether an interface port is used as its direction says: an input receives outside of its group
/// and sends inside, an output the other way round. `other` is the far end of the connection.
/// Reports what is wrong, once for each port; nothing if `port` is no interface port.
void CheckInterfaceDirection(const Port& port, const PathUse& use, PathKind end, const Port& other,
                             BuildContext& context);

}  // namespace runnel
