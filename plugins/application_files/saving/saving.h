#pragma once

#include <any>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <typeindex>
#include <vector>

#include "core/element/configurable.h"
#include "core/port/port.h"
#include "core/xml/xml_writing.h"
#include "plugins/application_files/saving/application_saver.h"
#include "plugins/parameters/file_path.h"

namespace runnel::internal {

/// A connection that a file has to say: not one within a module, nor one that leads out of the application.
struct SavedEdge {
  Port* from;  ///< nullptr: of a connection that waits for its ends (LateConnections), or will when a rule is over
  Port* to;    ///< likewise, unless its input is there, and its output another application's
  ConnectOptions options;
  FrameworkElement* home;      ///< the innermost group that has both ends
  bool is_saved = false;       ///< a tag says it
  std::string from_path = {};  ///< if it waits
  std::string to_path = {};
};
/// In the order in which they were made.
[[nodiscard]] std::vector<SavedEdge> EdgesOf(FrameworkElement& application);

/// One saving of an application: what all who take part in it share.
///
/// Threads: under the structure lock.
struct Saving {
  FrameworkElement& application;
  const SaveTools& tools;
  std::filesystem::path folder;  ///< where the text will stand
  std::vector<SavedEdge> edges;
  /// What the parameters that the text names come to when it is loaded again (LoadedValue).
  std::map<FrameworkElement*, std::string> values = {};
  /// Of the modules that the text names anew.
  std::set<std::string> plugins = {};
  std::optional<Error> error = {};  ///< the first
  std::string lost = {};            ///< what the text does not say any more, for people
  std::map<std::type_index, std::any> notes = {};

  /// What those who write one kind of word note for one another; empty when it is first asked for.
  template <typename Notes>
  [[nodiscard]] Notes& Note() {
    std::any& found = notes[typeid(Notes)];
    return found.has_value() ? *std::any_cast<Notes>(&found) : found.emplace<Notes>();
  }
  void Fail(Error reason) {
    if (!error) error = std::move(reason);
  }
  /// That a file can carry what is to be said of `element`.
  void CheckText(std::string_view text, const FrameworkElement& element);
  /// The same for an attribute; if it names a type of modules, its plugin has to be loaded.
  void CheckAttribute(const AttributeRule& rule, const std::string& value, const FrameworkElement& element);
};

/// The value as text that gives it again when it stands in the file: names of files start there.
[[nodiscard]] std::string SavedValue(const FrameworkElement& element, const Configurable& configurable,
                                     const Saving& saving);

struct SavedText {
  std::string text;
  std::map<FrameworkElement*, std::string> values;  ///< as Saving::values
  std::string lost;                                 ///< likewise
};
/// What SaveApplication() would write into a file in `folder`, but for whether it would load. Under the structure lock.
[[nodiscard]] Result<SavedText> TextOfApplication(FrameworkElement& application, const SaveTools& tools,
                                                  const std::filesystem::path& folder);

// The tags that give again what is in the tree, as if no file had been there before.

/// `saved` as an element, with all that is in it. `about`: the element that errors name.
[[nodiscard]] NewElement ElementOf(const XmlTag& tag, const SavedTag& saved, const FrameworkElement& about,
                                   Saving& saving);

/// The tags that may stand in another, in the order of XmlTag::place.
[[nodiscard]] std::vector<const XmlTag*> TagsWithin(std::string_view tag, const Saving& saving);

/// At or in a module that a rule has put in the place of another, which may have other ports and parameters.
[[nodiscard]] bool IsByRule(const FrameworkElement& element);

/// Such a group is made with its threads.
[[nodiscard]] bool HoldsOnlyThreads(const FrameworkElement& group);

/// Whether it is a module or group that a file says something of: not one that is made with threads.
[[nodiscard]] bool IsSaved(const FrameworkElement& element);

}  // namespace runnel::internal
