#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/element/configurable.h"
#include "plugins/application_files/saving/application_saver.h"
#include "plugins/application_files/saving/saved_edges.h"

namespace runnel::internal {

/// One saving of an application: what all who take part in it share.
///
/// Threads: under the structure lock.
struct Saving {
  FrameworkElement& application;
  const SaveTools& tools;
  std::filesystem::path folder;  ///< where the text will stand
  SavedEdges edges;
  /// What the parameters that the text names come to when it is loaded again.
  std::map<std::string, std::string, std::less<>> values = {};
  /// Of the modules that the text names anew.
  std::set<std::string> plugins = {};
  std::optional<Error> error = {};  ///< the first

  void Fail(Error reason) {
    if (!error) error = std::move(reason);
  }
  /// That a file can carry what is to be said of `element`.
  void CheckText(std::string_view text, const FrameworkElement& element);
  /// The same for an attribute; if it names a type of modules, its plugin has to be loaded.
  void CheckAttribute(const AttributeRule& rule, const std::string& value,
                      const FrameworkElement& element);
};

/// The value as text that gives it again when it stands in the file: names of files start there.
[[nodiscard]] std::string SavedValue(const Configurable& configurable, const Saving& saving);

/// `name` of a file, written in one folder, as it must be written in another.
[[nodiscard]] std::string MovedFileName(const std::string& name, const std::filesystem::path& from,
                                        const std::filesystem::path& to);

/// The first attribute that says what `tag` is called; "" if there is none.
[[nodiscard]] inline std::string NameOf(XmlElement tag) {
  const XmlAttribute* const name = tag.Attribute("name");
  return name != nullptr ? name->value : "";
}

/// Whether `text`, which is to stand in `file` for `application`, would load. Under the structure lock.
[[nodiscard]] Result<void> CheckSavedText(FrameworkElement& application, std::string_view text,
                                          const std::filesystem::path& file,
                                          const SaveTools& tools);

/// Whether a module or group of the application is for a file at all.
[[nodiscard]] bool IsSaved(const FrameworkElement& element);

}  // namespace runnel::internal
