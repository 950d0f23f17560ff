#include <utility>

#include "core/types/duration_text.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/run_description.h"
#include "plugins/application_files/tags/built_in_tags.h"

namespace runnel {

namespace {

void AddStuckReaction(const TagUse& use) {
  const FrameworkElement* const of = SearchElement(PathIn(use.Get("of"), use.parent), use.context);
  StuckReaction rule;
  rule.after = ParseDuration(use.Get("after").value).value();
  rule.on_stuck = internal::ReadReaction(use.xml, use.parent, use.context);
  for (const XmlElement child : use.xml.children()) {
    if (child.name() != "otherwise") continue;
    rule.on_return = internal::ReadReaction(child, use.parent, use.context);
  }
  if (of == nullptr) return;
  rule.of = of->path();
  internal::RunRulesAround(use.parent).stuck_reactions.push_back(std::move(rule));
}

}  // namespace

XmlTag OnStuckTag() {
  return {.name = "on_stuck",
          .summary = "what happens when a module does not return from its cycle, on the real clock; it is told of in "
                     "any case",
          .parents = {"application", "group"},
          .attributes = {{.name = "of",
                          .kind = AttributeKind::kPath,
                          .required = true,
                          .summary = "a module, or a group of which any module may be stuck",
                          .names_element = true},
                         {.name = "after",
                          .kind = AttributeKind::kDuration,
                          .required = true,
                          .summary = "the longest time in one cycle, by the machine's clock"}},
          .handle = [](const TagUse& use) -> FrameworkElement* {
            use.context.Defer(BuildStage::kChecks, [use] { AddStuckReaction(use); });
            return &use.parent;
          }};
}

}  // namespace runnel
