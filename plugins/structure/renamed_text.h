#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/xml/xml_document.h"

namespace runnel {

namespace internal {
/// The first attribute that says what `tag` is called; "" if there is none.
[[nodiscard]] inline std::string NameOf(XmlElement tag) {
  const XmlAttribute* const name = tag.Attribute("name");
  return name != nullptr ? name->value : "";
}
}  // namespace internal

/// An attribute by which a tag of an application file names elements, or makes one.
struct PathAttribute {
  enum class Kind { kNewName, kPath, kPathList };

  std::string name;
  Kind kind = Kind::kPath;
};
using PathAttributesOf = std::function<std::vector<PathAttribute>(XmlElement tag)>;

/// What is called otherwise than in its file (NameInFile): paths in the names of the file, and names.
using NewNames = std::map<std::string, std::string, std::less<>>;
[[nodiscard]] NewNames NewNamesIn(FrameworkElement& application);
/// The file calls everything as it is called now.
void ForgetNewNames(FrameworkElement& application);

/// A path of the file, seen from `base`, in new names.
[[nodiscard]] std::string RenamedPath(std::string_view path, const std::string& base, const NewNames& names);
/// The text with what has been renamed called as it is now, wherever a tag or a path names it; else byte for byte.
/// Errors: it is no XML.
[[nodiscard]] Result<std::string> RenamedText(const std::string& text, const std::string& file, const NewNames& names,
                                              const PathAttributesOf& attributes);

}  // namespace runnel
