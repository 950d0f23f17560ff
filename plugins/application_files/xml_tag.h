#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/plugin/plugin_registry.h"
#include "core/xml/xml_document.h"
#include "core/xml/xml_writing.h"
#include "plugins/structure/renamed_text.h"

namespace runnel {

/// What may stand in an attribute of an application file.
enum class AttributeKind {
  kText,        ///< anything
  kName,        ///< what can name an element (core/element/element_path.h)
  kNewName,     ///< the same, of the element that the tag makes
  kPath,        ///< one path, not empty
  kPathList,    ///< paths separated by blanks, at least one
  kCount,       ///< 0, 1, 2 …
  kNumber,      ///< finite
  kDuration,    ///< longer than nothing, with unit: "50ms"
  kChoice,      ///< one of AttributeRule::choices
  kModuleType,  ///< that a plugin has brought
  kPortType,    ///< of values, that something in the program or in a plugin uses
};

/// One attribute that a tag understands.
struct AttributeRule {
  std::string name;
  AttributeKind kind = AttributeKind::kText;
  bool required = false;
  std::string summary = {};  ///< one line, told to those who have left out what is required
  std::vector<std::string> choices = {};
  /// Paths in it lead to elements of the tree: a tag whose path leads nowhere any more means
  /// nothing, and is left out when the application is saved.
  bool names_element = false;
};
/// One that has one of some words.
[[nodiscard]] inline AttributeRule WordRule(const char* name, std::vector<std::string> words, const char* summary = "",
                                            bool required = false) {
  return {name, AttributeKind::kChoice, required, summary, std::move(words)};
}

[[nodiscard]] inline AttributeRule KindRule(const char* name, AttributeKind kind, const char* summary,
                                            bool required = false) {
  return {.name = name, .kind = kind, .required = required, .summary = summary};
}

/// Whether `value` may stand in the attribute, as far as its form goes; the error says what may.
Result<void> CheckAttributeValue(const AttributeRule& rule, std::string_view value);

/// The values of attributes, for those who handle tags (durations: core/types/duration_text.h).
/// Errors say what is wrong, without a place.
Result<std::size_t> ParseCount(std::string_view text);
/// The words of a list of paths. Commas separate as well, so that more can be said of a list that
/// has them by mistake; as a value it is refused.
[[nodiscard]] std::vector<std::string> SplitPaths(std::string_view text);

class BuildContext;
namespace internal {
class FileUpdate;
struct Saving;
}  // namespace internal

/// One tag of an application file, as whoever builds the application meets it. Its attributes have
/// been checked against the rules: those that are required are there, and all values are of their
/// kind.
///
/// Copies are cheap enough to be kept by deferred actions.
struct TagUse {
  XmlElement xml;
  FrameworkElement& parent;  ///< what the enclosing tag has made
  BuildContext& context;

  /// nullptr if it is not there.
  [[nodiscard]] const XmlAttribute* Find(std::string_view attribute) const { return xml.Attribute(attribute); }
  /// Precondition: the rules require the attribute.
  [[nodiscard]] const XmlAttribute& Get(std::string_view attribute) const;
  /// Of what the tag makes, whether it has been made or not: the parent's, and the name, if any.
  [[nodiscard]] std::string path() const;
  /// As BuildContext::Report(), about what the tag makes.
  void Report(Error error, const SourcePosition& position) const;
  /// Whether nothing in `where` is called as the tag says; if something is, that is reported.
  [[nodiscard]] bool HasFreeName(const FrameworkElement& where) const;
};

/// An attribute as a saved file should have it.
struct SavedAttribute {
  std::string name;
  std::string value;
  bool is_default = false;  ///< a file that leaves it out says the same
  bool is_kept = false;     ///< whatever the file has, and nothing in a new one
};

/// A tag as a saved file should have it; two tags of one place are told apart by their first attribute if
/// that is their name.
struct SavedTag {
  std::vector<SavedAttribute> attributes = {};
  FrameworkElement* element = nullptr;  ///< that it and the tags within it are about, if there is one
};

/// A word of the language of application files. Plugins add their own:
///
///     if (auto* tags = registry.Find<XmlTagRegistry>()) {
///       tags->AddTag({.name = "thread", .parents = {"application"}, .attributes = {…},
///                     .handle = [](const TagUse& use) -> FrameworkElement* { … }});
///     }
struct XmlTag {
  std::string name;
  std::string summary = {};          ///< one line, told to those who write it in a wrong place
  std::vector<std::string> parents;  ///< tags that it may stand in; none: it is the root
  std::vector<AttributeRule> attributes = {};
  /// Handled before all other tags of the file are even looked at, since it may bring new tags.
  bool comes_first = false;
  bool is_part = false;  ///< the root of a file that others use, not of an application
  /// Makes elements, or connects them: if it is wrong, what is missing elsewhere may be its fault.
  bool is_structure = false;
  /// Makes what the tag asks for and returns the element that the tags within it go below: a new
  /// one, or use.parent. Nothing if it could not, after reporting why to use.context. What needs
  /// the rest of the file is put off with use.context.Defer(). Exceptions become errors at the tag. Without,
  /// the tag makes nothing, and is read by the one that it stands in.
  std::function<FrameworkElement*(const TagUse& use)> handle = {};
  /// For those that make what comes and goes while the application lives: all tags of this name that
  /// a file needs directly in `parent` to get what is there now. Without, a file that is saved keeps
  /// the tags that it has.
  std::function<std::vector<SavedTag>(FrameworkElement& parent)> saved = {};
  /// Instead, for those that cannot be compared one by one: brings a tag that the file has in `parent` up
  /// to date …
  std::function<void(XmlElement tag, FrameworkElement& parent, internal::FileUpdate& update)> update = {};
  /// … and says which it lacks. `tag`: of `parent`; nullptr, as `update`, in a new file.
  std::function<std::vector<NewElement>(const XmlElement* tag, FrameworkElement& parent, internal::Saving& saving,
                                        internal::FileUpdate* update)>
      missing = {};
  int place = 0;            ///< in files that are written anew, from the first to the last
  std::string plugin = {};  ///< that added it; filled in by the registry
};

/// An attribute that a plugin adds to tags of others: thread="control" on <module>.
struct AddedAttribute {
  std::string tag;
  AttributeRule rule;
  /// Called after the tag has made `element`, for each use of the attribute.
  std::function<void(const XmlAttribute& attribute, FrameworkElement& element, BuildContext& context)> handle;
  /// The value that a saved file needs to get what `element` has now; "" if none.
  std::function<std::string(FrameworkElement& element)> saved = {};
  std::string plugin = {};
};

/// The words that application files may use: those that every file may (ApplicationTags() in
/// plugins/application_tags makes a registry of them), and those of plugins. Offer it to the plugin manager
/// (PluginRegistry::Offer) before loading plugins.
///
/// Threads: not thread-safe.
class XmlTagRegistry final : public OfferedRegistry {
 public:
  /// Both throw ElementError if the word is taken, as registrations of plugins do.
  void AddTag(XmlTag tag);
  void AddAttribute(AddedAttribute attribute);
  /// Is asked for tags that are not there, and those of plugins: the plugin may be loaded, and nobody has made its extension.
  /// Adds those that it knows of. Errors: it has one, and cannot add it.
  using Source = std::function<Result<void>(std::string_view tag)>;
  void set_source(Source source) { source_ = std::move(source); }
  /// Has the tag added if it is not there and somebody knows of it. Errors: the source's.
  Result<void> Bring(std::string_view tag) const {
    const XmlTag* const known = FindTag(tag);
    return source_ && (known == nullptr || !known->plugin.empty()) ? source_(tag) : Result<void>();
  }
  std::function<void()> SetAside(std::string_view plugin) override;
  void set_plugin(const std::string& plugin) override { plugin_ = plugin; }

  [[nodiscard]] const XmlTag* FindTag(std::string_view name) const;
  [[nodiscard]] std::vector<const AddedAttribute*> AddedAttributes(std::string_view tag) const;
  /// The rules for all attributes of the tag, those of plugins included.
  [[nodiscard]] std::vector<AttributeRule> Rules(const XmlTag& tag) const;
  /// The names of the tags that may stand in `parent`, sorted. Whatever may stand in a <group> may
  /// stand in a <group_type>.
  [[nodiscard]] std::vector<std::string> TagsIn(std::string_view parent) const;

 private:
  std::map<std::string, XmlTag, std::less<>> tags_;
  std::vector<AddedAttribute> added_attributes_;
  std::string plugin_;
  Source source_;
};

/// By which attributes the tags name elements. The registry must outlive it.
[[nodiscard]] PathAttributesOf PathAttributesIn(const XmlTagRegistry& tags);

}  // namespace runnel
