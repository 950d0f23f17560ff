#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"
#include "core/xml/xml_document.h"

namespace runnel {

/// Kept with an element that has been renamed: what the file of its application still calls it. Saving has the file
/// call it as it is called now.
struct NameInFile final : Annotation {
  explicit NameInFile(std::string called) : name(std::move(called)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<NameInFile>(name);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  std::string name;

  /// Of any element.
  [[nodiscard]] static const std::string& Of(const FrameworkElement& element) {
    const auto* const known = element.FindAnnotation<NameInFile>();
    return known != nullptr ? known->name : element.name();
  }
  /// `made` stands for what has been called as `before` is.
  static void Note(FrameworkElement& made, const FrameworkElement& before) {
    if (Of(before) != made.name()) made.Annotate(std::make_unique<NameInFile>(Of(before)));
  }
};

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
