#include "plugins/supervision/xml_supervision_tags.h"

#include <memory>
#include <utility>
#include <vector>

#include "core/base/saturating_sum.h"
#include "core/types/duration_text.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/path_use.h"
#include "plugins/supervision/xml_reactions.h"

namespace runnel {

namespace {

template <typename Rule>
struct Placed {
  Rule rule;
  SourcePosition position;
};

struct SupervisionRules final : Annotation {
  std::vector<Placed<StaleRule>> stale;
  std::vector<Placed<FaultReaction>> faults;
};

// With the application: what is directly below the root.
SupervisionRules& RulesOf(FrameworkElement& element) {
  FrameworkElement* at = &element;
  while (at->parent()->parent() != nullptr) at = at->parent();
  auto* rules = at->FindAnnotation<SupervisionRules>();
  return rules != nullptr ? *rules : at->Annotate(std::make_unique<SupervisionRules>());
}

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
  const Port* const port = SearchPort(PathIn(input, use.parent), PathKind::kInput, use.context);
  if (port == nullptr) return;
  if (port->Sources().empty()) {
    use.context.Report({.message = "cannot become stale, as nothing is connected to it",
                        .path = port->path(),
                        .hint = "connect it, or leave out <on_stale>"},
                       input.value_position, use.parent);
    return;
  }
  rule.input = port->path();
  RulesOf(use.parent).stale.push_back({std::move(rule), use.xml.position()});
}

FrameworkElement* HandleOnStale(const TagUse& use) {
  if (use.xml.children().empty()) {
    use.context.Report({.message = "<on_stale> does not say what is to be done",
                        .hint = "put <switch>, <set>, <replace> or <stop> into it"},
                       use.xml.position(), use.parent);
  }
  use.context.Defer(BuildStage::kChecks, [use] { AddStaleRule(use); });
  return &use.parent;
}

void AddFaultReaction(XmlElement xml, const TagUse& use) {
  const XmlAttribute* const of = xml.Attribute("of");
  FaultReaction rule;
  rule.reaction = internal::ReadReaction(xml, use.parent, use.context);
  // What is wrong with it has been reported by <on_fault> itself.
  const auto found = of ? use.parent.Find(of->value) : Result<FrameworkElement*>(Error{});
  if (!found) return;
  rule.of = (*found)->path();
  RulesOf(use.parent).faults.push_back({std::move(rule), xml.position()});
}

// What stands in <on_stale> is read with it. <on_fault> is a word of scheduling's, which knows nothing
// of these: the first one in it has all of them read.
FrameworkElement* HandleReaction(const TagUse& use) {
  const auto around = use.xml.parent();
  if (around && around->name() == "on_fault" && around->children().front() == use.xml) {
    use.context.Defer(BuildStage::kChecks, [use, xml = *around] { AddFaultReaction(xml, use); });
  }
  return &use.parent;
}

XmlTag OnStaleTag() {
  return {.name = "on_stale",
          .summary = "what happens when an input brings nothing new for too long",
          .parents = {"application", "group"},
          .attributes = {{.name = "input",
                          .kind = AttributeKind::kPath,
                          .required = true,
                          .summary = "what feeds it when the run begins is watched",
                          .names_element = true},
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

template <typename Rules>
Result<void> AddAll(const Rules& rules, Supervisor& supervisor) {
  for (const auto& [rule, position] : rules) {
    if (auto added = supervisor.Add(rule); !added) {
      Error error = added.error();
      error.position = position;
      return error;
    }
  }
  return {};
}

}  // namespace

void AddSupervisionTags(XmlTagRegistry& tags) {
  tags.AddTag(OnStaleTag());
  tags.AddTag({.name = "otherwise",
               .summary = "what happens when the input is fresh again",
               .parents = {"on_stale"},
               .handle = [](const TagUse& use) { return &use.parent; }});
  for (XmlTag& tag : internal::ReactionTags(HandleReaction)) tags.AddTag(std::move(tag));
}

Result<void> AddSupervisionRules(const FrameworkElement& application, Supervisor& supervisor) {
  const auto* const rules = application.FindAnnotation<SupervisionRules>();
  if (rules == nullptr) return {};
  if (auto added = AddAll(rules->stale, supervisor); !added) return added;
  return AddAll(rules->faults, supervisor);
}

}  // namespace runnel
