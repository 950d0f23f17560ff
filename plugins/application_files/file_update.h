#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/port/proxy_port.h"
#include "core/xml/xml_editor.h"
#include "plugins/application_files/saving.h"
#include "plugins/runtime_construction/application_source.h"
#include "plugins/runtime_construction/port_search.h"

namespace runnel::internal {

/// Brings the text that an application came from up to what the application is: tags whose element
/// is gone are cut out, what has changed is rewritten, what is new appended to the tag of its group.
class FileUpdate {
 public:
  FileUpdate(Saving& saving, const ApplicationSource& source, XmlEditor& editor);

  void Run(XmlElement root);

 private:
  // First all tags that are there …
  void UpdateGroup(XmlElement tag, FrameworkElement& group);
  void UpdateChild(XmlElement tag, FrameworkElement& group);
  void UpdateModule(XmlElement tag, FrameworkElement& module);
  void UpdateParameter(XmlElement tag, FrameworkElement& module, std::set<std::string>& named);
  void AddParameters(XmlElement tag, FrameworkElement& module, const std::set<std::string>& named);
  void UpdatePort(XmlElement tag, FrameworkElement& group);
  void UpdateConnect(XmlElement tag, FrameworkElement& group);
  // Whether a tag says it already; if not, and the tag may be changed, the tag says it from now on.
  bool SaysConnection(XmlElement tag, Port* from, Port* to, bool is_only_one);
  void UpdateAddedAttributes(XmlElement tag, FrameworkElement& element);
  void UpdateOther(XmlElement tag, FrameworkElement& parent);
  void UpdateSavedTags(XmlElement tag, FrameworkElement& parent);
  void UpdateSavedTag(XmlElement tag, const SavedTag& saved);
  void UpdateLoad(XmlElement tag);
  // … then what has none.
  void AppendNew(XmlElement tag, FrameworkElement& group);
  void GiveTypes();
  void AppendLoads(XmlElement root);

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
};

/// Whether two values of an attribute mean the same, as "0.05 s" and "50ms" do.
[[nodiscard]] bool MeanTheSame(const AttributeRule& rule, const std::string& one,
                               const std::string& other);

}  // namespace runnel::internal
