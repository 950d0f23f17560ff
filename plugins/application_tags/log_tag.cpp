#include "core/log/log_levels.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

FrameworkElement* HandleLog(const TagUse& use) {
  use.context.Defer(BuildStage::kChecks, [use] {
    const XmlAttribute* const of = use.Find("of");
    const FrameworkElement* const subtree =
        of != nullptr ? SearchElement(PathIn(*of, use.parent), use.context) : &use.parent;
    if (subtree == nullptr) return;
    SetLogLevel(use.context.runtime(), subtree->path(), LogLevelOf(use.Get("level").value).value());
  });
  return &use.parent;
}

}  // namespace

XmlTag LogTag() {
  return {.name = "log",
          .summary = "what modules say is logged from this level on",
          .parents = {"application", "group"},
          .attributes = {{.name = "level",
                          .kind = AttributeKind::kChoice,
                          .required = true,
                          .summary = "the least that is logged; info if nothing is said",
                          .choices = {LogLevelNames().begin(), LogLevelNames().end()}},
                         PathRule("of", false, "the module or group, with all below it; the one around if left out")},
          .handle = HandleLog};
}

}  // namespace runnel
