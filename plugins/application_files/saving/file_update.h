#pragma once

#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/port/port.h"
#include "core/xml/xml_editor.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/saving/saving.h"

namespace runnel::internal {

/// Sets a parameter of a module in a group that another file describes; `module` seen from there.
using SetOverride = std::function<void(const std::string& module, const std::string& name, const std::string& value)>;

/// Brings the text that an application came from up to what the application is: tags whose element
/// is gone are cut out, what has changed is rewritten, what is new appended to the tag of its group.
/// What that is, each tag says itself (XmlTag::saved, update, missing).
class FileUpdate {
 public:
  FileUpdate(Saving& saving, const ApplicationSource& source, XmlEditor& editor);
  ~FileUpdate();

  void Run(XmlElement root);

  // For tags.

  [[nodiscard]] Saving& saving() noexcept { return saving_; }
  [[nodiscard]] XmlEditor& editor() noexcept { return editor_; }
  /// Whether the text is that of a group in several applications, in which nothing is changed.
  [[nodiscard]] bool is_of_part() const noexcept { return part_ != nullptr; }
  /// The name of a file, which may have to be written otherwise, as the text goes to another folder.
  [[nodiscard]] std::string Moved(const std::string& file) const;
  /// The port is at an end of a connection that has come or gone.
  void Touch(const Port* port) { touched_.insert(port); }
  /// The file loads it.
  void NoteLoad(const std::string& plugin) { loads_.insert(plugin); }
  /// In a group that another file describes, where nothing can be added: sets it for that group. False:
  /// it is none.
  bool OverrideValue(const FrameworkElement& parameter, const std::string& value);

 private:
  struct Part;
  /// A tag and the element that the tags within it are about, with those that it still lacks.
  struct Inside {
    XmlElement tag;
    FrameworkElement& element;
    std::map<std::string, std::vector<SavedTag>, std::less<>> lacking = {};
  };

  // First all tags that are there …
  void UpdateInside(XmlElement tag, FrameworkElement& element);
  void UpdateTag(XmlElement tag, Inside& around);
  void UpdateAttributes(XmlElement tag, const XmlTag& known, const SavedTag& saved, const FrameworkElement& about);
  void UpdateAddedAttributes(XmlElement tag, FrameworkElement& element);
  [[nodiscard]] bool NamesWhatIsGone(XmlElement tag, FrameworkElement& parent) const;
  // … then what has none.
  void AppendMissing(Inside& inside);
  void AppendLoads(XmlElement root);

  // Groups that other files describe: nothing may be changed there but values of parameters.
  void UpdateInstance(XmlElement tag, FrameworkElement& group);
  void Override(XmlElement tag, const std::string& module, const std::string& name, const std::string& value);
  void MoveFileNames(XmlElement tag, XmlElement root, FrameworkElement& group);
  void FinishParts();

  [[nodiscard]] bool IsMoved() const;

  Saving& saving_;
  const ApplicationSource& source_;
  const std::filesystem::path old_folder_;
  XmlEditor& editor_;
  std::list<Inside> insides_;  // in the order of the file
  std::vector<std::pair<XmlElement, const Port*>> untyped_;
  std::set<const Port*> touched_;
  std::set<std::string> loads_;
  std::vector<std::unique_ptr<Part>> parts_;
  // Of a part only:
  FrameworkElement* part_ = nullptr;
  SetOverride set_override_;
};

/// Whether two values of an attribute mean the same, as "0.05 s" and "50ms" do.
[[nodiscard]] bool MeanTheSame(const AttributeRule& rule, const std::string& one, const std::string& other);

}  // namespace runnel::internal
