#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/port/proxy_port.h"
#include "core/xml/xml_editor.h"
#include "plugins/application_files/saving.h"
#include "plugins/runtime_construction/application_source.h"
#include "plugins/runtime_construction/path_use.h"

namespace runnel::internal {

/// Sets a parameter of a module in a group that another file describes; `module` seen from there.
using SetOverride = std::function<void(const std::string& module, const std::string& name,
                                       const std::string& value)>;

/// Brings the text that an application came from up to what the application is: tags whose element
/// is gone are cut out, what has changed is rewritten, what is new appended to the tag of its group.
class FileUpdate {
 public:
  FileUpdate(Saving& saving, const ApplicationSource& source, XmlEditor& editor);
  ~FileUpdate();

  void Run(XmlElement root);

 private:
  struct Part;
  // First all tags that are there …
  void UpdateGroup(XmlElement tag, FrameworkElement& group);
  void UpdateChild(XmlElement tag, FrameworkElement& group);
  void UpdateInstance(XmlElement tag, FrameworkElement& group);
  void Override(XmlElement tag, const std::string& module, const std::string& name,
                const std::string& value);
  // The inside of a group that another file describes: nothing may be changed there but values of
  // parameters, which go to `set`.
  void UpdatePart(XmlElement root, FrameworkElement& outermost, FrameworkElement& group,
                  SetOverride set);
  void MoveFileNames(XmlElement tag, XmlElement root, FrameworkElement& group);
  void WriteValue(XmlElement module_tag, const XmlElement* tag,
                  const ConfigurableElement& parameter);
  void UpdateModule(XmlElement tag, FrameworkElement& module);
  void UpdateParameter(XmlElement tag, FrameworkElement& module, std::set<std::string>& named);
  void AddParameters(XmlElement tag, FrameworkElement& module, const std::set<std::string>& named);
  void UpdatePort(XmlElement tag, FrameworkElement& group);
  void UpdateConnect(XmlElement tag, FrameworkElement& group);
  // Whether a tag says it already; if not, and the tag may be changed, the tag says it from now on.
  bool SaysConnection(XmlElement tag, Port* from, Port* to, bool is_only_one);
  void UpdateAddedAttributes(XmlElement tag, FrameworkElement& element);
  void UpdateOther(XmlElement tag, FrameworkElement& parent);
  [[nodiscard]] bool NamesWhatIsGone(XmlElement tag, FrameworkElement& parent) const;
  void UpdateSavedTags(XmlElement tag, FrameworkElement& parent);
  void UpdateSavedTag(XmlElement tag, const SavedTag& saved);
  void UpdateLoad(XmlElement tag);
  // … then what has none.
  void AppendNew(XmlElement tag, FrameworkElement& group);
  void GiveTypes();
  void AppendLoads(XmlElement root);

  void FinishParts();

  [[nodiscard]] bool IsMoved() const;

  Saving& saving_;
  const ApplicationSource& source_;
  const std::filesystem::path old_folder_;
  XmlEditor& editor_;
  std::vector<std::pair<XmlElement, FrameworkElement*>> groups_;  // in the order of the file
  std::set<const FrameworkElement*> has_tag_;
  std::vector<std::pair<XmlElement, const Port*>> untyped_;
  std::set<const Port*> touched_;  // at an end of a connection that has come or gone
  std::set<std::string> loads_;
  std::vector<std::unique_ptr<Part>> parts_;
  // Of a part only:
  FrameworkElement* part_ = nullptr;
  SetOverride set_override_;
};

/// "" if it has none.
[[nodiscard]] inline std::string NameOf(XmlElement tag) {
  const XmlAttribute* const name = tag.Attribute("name");
  return name != nullptr ? name->value : "";
}

/// Whether two values of an attribute mean the same, as "0.05 s" and "50ms" do.
[[nodiscard]] bool MeanTheSame(const AttributeRule& rule, const std::string& one,
                               const std::string& other);

}  // namespace runnel::internal
