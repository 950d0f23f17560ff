#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/element/annotation.h"
#include "core/element/framework_element.h"
#include "core/xml/xml_document.h"
#include "plugins/application_files/xml_tag.h"

namespace runnel {

/// A file of an application, or of a part of one, that has been read and parsed, once for all who look at it.
struct ApplicationFile {
  std::filesystem::path file;
  std::string text;  ///< byte for byte
  XmlDocument document;

  /// Errors: it cannot be read; it is no XML.
  static Result<ApplicationFile> Read(const std::filesystem::path& file);
};

/// Kept with a group whose inside another file describes.
struct PartInstance final : Annotation {
  explicit PartInstance(std::string file_name) : file(std::move(file_name)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<PartInstance>(file);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  std::string file;  ///< as errors call it
};

/// "wheel.xml:5:22".
[[nodiscard]] std::string PlaceText(const SourcePosition& place);

/// "instantiated at app.xml:3:5" for a place in a file and the element that it is about; "" for the
/// application file.
[[nodiscard]] std::string UseChain(const std::string& file, const FrameworkElement& element);

/// One use of such a file while the application is built.
struct PartUse {
  FrameworkElement& group;
  XmlElement tag;                                            ///< `<group type="…">`
  XmlElement root;                                           ///< `<group_type>`
  std::map<std::string, TagUse, std::less<>> declared = {};  ///< its parameters …
  std::map<std::string, TagUse, std::less<>> given = {};     ///< … and what the use makes of them
  std::set<std::string, std::less<>> used = {};              ///< by something within
};

/// The files that describe the inside of groups, each read once for one build, and their uses.
///
/// Threads: used by the building thread.
class PartFiles {
 public:
  explicit PartFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Where relative names in a file start. For unknown ones, in the folder of the application.
  [[nodiscard]] std::filesystem::path FolderOf(const std::string& file) const;

  /// Opens the file that `tag` names, until Close(). Errors: it is not there, is no part, contains
  /// itself; there are too many.
  Result<PartUse*> Open(const XmlAttribute& type, XmlElement tag, FrameworkElement& group);
  void Close() { open_.pop_back(); }

  /// The use that `group` is; nullptr if it is none.
  [[nodiscard]] PartUse* Find(const FrameworkElement& group);
  /// The innermost use that `element` is, or is in; nullptr if there is none.
  [[nodiscard]] PartUse* FindAround(const FrameworkElement* element);
  [[nodiscard]] std::vector<XmlElement> Roots() const;
  /// What the files say, by the names that errors have for them.
  [[nodiscard]] std::map<std::string, std::string> TakeTexts();

 private:
  struct Opened {
    std::string name;
    SourcePosition used_at;
  };
  Result<const ApplicationFile*> Read(const std::string& name);
  [[nodiscard]] std::optional<Error> FindCircle(const std::string& name, const SourcePosition& position) const;

  const std::filesystem::path folder_;
  std::map<std::string, ApplicationFile> files_;  // by canonical names as errors have them
  std::vector<Opened> open_;
  std::map<const FrameworkElement*, PartUse> uses_;
};

}  // namespace runnel
