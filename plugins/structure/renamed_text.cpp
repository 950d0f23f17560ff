#include "plugins/structure/renamed_text.h"

#include <algorithm>

#include "core/element/element_path.h"
#include "core/xml/xml_editor.h"

namespace runnel {

namespace {

using Kind = PathAttribute::Kind;

std::string PathInFile(const FrameworkElement& element) {
  if (element.parent() == nullptr) return {};
  return PathInFile(*element.parent()) + "/" + NameInFile::Of(element);
}

// A path of the file, where it stands in `base`, with the elements that it leads by; `rename` says what the one at a
// path is to be called, "" if that is right.
std::string Followed(std::string_view path, std::string base,
                     const std::function<std::string(const std::string&)>& rename) {
  if (IsAbsolutePath(path)) base.clear();
  std::string text;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view name = path.substr(begin, end - begin);
    std::string other;
    if (name == "..") {
      base.erase(std::min(base.rfind('/'), base.size()));
    } else if (!name.empty() && name != ".") {
      base += "/" + std::string(name);
      other = rename(base);
    }
    text += begin > 0 ? "/" : "";
    text += other.empty() ? std::string(name) : other;
    begin = end + 1;
  }
  return text;
}

// Each word of a list, with what stands between them.
std::string ForEachWord(const std::string& list, const std::function<std::string(const std::string&)>& change) {
  constexpr const char* kBlanks = " \t\r\n";
  std::string text;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t begin = std::min(list.find_first_not_of(kBlanks, at), list.size());
    const std::size_t end = std::min(list.find_first_of(kBlanks, begin), list.size());
    text += list.substr(at, begin - at);
    if (end > begin) text += change(list.substr(begin, end - begin));
    at = end;
  }
  return text;
}

using Meet = std::function<void(XmlElement tag, const PathAttribute& known, const XmlAttribute& attribute,
                                const std::string& base)>;

// All attributes that name elements by paths or make them, of the tag and those within it.
void VisitPaths(XmlElement tag, const std::string& base, const PathAttributesOf& attributes, const Meet& meet) {
  std::string inside = tag.name() == "application" ? base + "/" + internal::NameOf(tag) : base;
  for (const PathAttribute& known : attributes(tag)) {
    const XmlAttribute* const attribute = tag.Attribute(known.name);
    if (attribute == nullptr) continue;
    meet(tag, known, *attribute, base);
    if (known.kind == Kind::kNewName) inside = base + "/" + attribute->value;
  }
  for (const XmlElement child : tag.children()) VisitPaths(child, inside, attributes, meet);
}

}  // namespace

NewNames NewNamesIn(FrameworkElement& application) {
  NewNames names;
  application.Visit([&](FrameworkElement& each) {
    if (NameInFile::Of(each) != each.name()) names.emplace(PathInFile(each), each.name());
  });
  return names;
}

void ForgetNewNames(FrameworkElement& application) {
  application.Visit([](FrameworkElement& each) {
    if (auto* const known = each.FindAnnotation<NameInFile>()) known->name = each.name();
  });
}

std::string RenamedPath(std::string_view path, const std::string& base, const NewNames& names) {
  return Followed(path, base, [&](const std::string& element) {
    const auto found = names.find(element);
    return found != names.end() ? found->second : std::string();
  });
}

Result<std::string> RenamedText(const std::string& text, const std::string& file, const NewNames& names,
                                const PathAttributesOf& attributes) {
  if (names.empty()) return text;
  const auto document = XmlDocument::Parse(text, file);
  if (!document) return document.error();
  XmlEditor editor(*document, text);
  VisitPaths(document->root(), "", attributes,
             [&](XmlElement tag, const PathAttribute& known, const XmlAttribute& attribute, const std::string& base) {
               const auto rename = [&](const std::string& path) { return RenamedPath(path, base, names); };
               const std::string value =
                   known.kind == Kind::kPathList ? ForEachWord(attribute.value, rename) : rename(attribute.value);
               if (value != attribute.value) editor.SetAttribute(tag, known.name, value);
             });
  return editor.Finish();
}

}  // namespace runnel
