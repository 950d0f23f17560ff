#include <memory>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/types/duration_text.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

void AddStaleRule(const TagUse& use) {
  const XmlAttribute& input = use.Get("input");
  const XmlAttribute* const fresh_after = use.Find("fresh_after");
  StaleRule rule;
  rule.after = ParseDuration(use.Get("after").value).value();
  rule.fresh_after = fresh_after ? ParseDuration(fresh_after->value).value()
                                 : SaturatingSum(Time(rule.after), rule.after).time_since_epoch();
  rule.on_stale = internal::ReadReaction(use.xml, use.parent, use.context);
  for (const XmlElement child : use.xml.children()) {
    if (child.name() != "otherwise") continue;
    rule.on_fresh = internal::ReadReaction(child, use.parent, use.context);
  }
  rule.on_fresh.TakeBack(rule.on_stale);
  const Port* const port = SearchPort(PathIn(input, use.parent), PathKind::kInput, use.context);
  if (port == nullptr) return;
  if (port->Sources().empty()) {
    if (!use.context.ok() && !use.context.IsUnfedUnnoticed(*port)) return;
    use.context.Report({.message = "cannot become stale, as nothing is connected to it",
                        .path = port->path(),
                        .hint = "connect it, or leave out <on_stale>"},
                       input.value_position, use.parent);
    return;
  }
  rule.input = port->path();
  internal::RunRulesAround(use.parent).stale_rules.push_back({std::move(rule), use.xml.position()});
}

FrameworkElement* HandleOnStale(const TagUse& use) {
  if (use.xml.children().empty()) {
    use.context.Report({.message = "<on_stale> does not say what is to be done",
                        .hint = "put <publish>, <switch>, <set>, <replace> or <stop> into it"},
                       use.xml.position(), use.parent);
  }
  use.context.Defer(BuildStage::kChecks, [use] { AddStaleRule(use); });
  return &use.parent;
}

}  // namespace

XmlTag OnStaleTag() {
  return {.name = "on_stale",
          .summary = "what happens when an input brings nothing new for too long",
          .parents = {"application", "group"},
          .attributes = {PathRule("input", true, "what feeds it when the run begins is watched"),
                         {.name = "after",
                          .kind = AttributeKind::kDuration,
                          .required = true,
                          .summary = "the longest time without anything new, by the application's "
                                     "clock"},
                         {.name = "fresh_after",
                          .kind = AttributeKind::kDuration,
                          .summary = "how long values must come again before <otherwise> is done; "
                                     "twice 'after' if left out"}},
          .handle = HandleOnStale};
}

XmlTag OtherwiseTag() {
  return {.name = "otherwise",
          .summary = "what happens when the input is fresh again, the module has returned or goes on",
          .parents = {"on_stale", "on_stuck", "on_pause"}};
}

}  // namespace runnel
