#include <memory>
#include <utility>

#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/path_use.h"
#include "plugins/scheduling_tags/xml_scheduling_tags.h"

namespace runnel {

namespace {

struct FaultRules final : Annotation {
  std::vector<PlacedFaultRule> rules;
};

void AddRule(const TagUse& use) {
  FaultRule rule;
  const FrameworkElement* const of = SearchElement(PathIn(use.Get("of"), use.parent), use.context);
  const XmlAttribute* const set = use.Find("set");
  const XmlAttribute* const value = use.Find("value");
  if (set != nullptr) {
    if (value == nullptr) return;
    const FrameworkElement* const target = SearchSettable(*set, *value, use.parent, use.context);
    if (target == nullptr) return;
    rule.action = FaultRule::Action::kSet;
    rule.target = target->path();
    rule.value = value->value;
  }
  if (of == nullptr) return;
  rule.of = of->path();
  FrameworkElement& application = internal::ApplicationOf(use.parent);
  auto* rules = application.FindAnnotation<FaultRules>();
  if (rules == nullptr) rules = &application.Annotate(std::make_unique<FaultRules>());
  rules->rules.push_back({std::move(rule), use.xml.position()});
}

FrameworkElement* HandleOnFault(const TagUse& use) {
  const bool acts = use.xml.Attribute("action") != nullptr;
  const bool sets = use.xml.Attribute("set") != nullptr;
  const bool has_value = use.xml.Attribute("value") != nullptr;
  const auto report = [&](Error error) {
    use.context.Report(std::move(error), use.xml.position(), use.parent);
  };
  const bool has_tags = !use.xml.children().empty();  // other plugins' words, which they read
  if (acts + sets + has_tags != 1) {
    report({.message = "<on_fault> must say one thing that is to be done",
            .hint = "write either action=\"stop_application\" or set=\"…\" value=\"…\""});
  }
  if (sets != has_value) {
    report({.message = sets ? "<on_fault> does not say to which value" : "'value' needs a 'set'",
            .hint = sets ? "add value=\"…\"" : "add set=\"…\", or leave out value"});
  }
  if (has_tags) {
    use.context.Defer(BuildStage::kConnections, [use] {
      (void)SearchElement(PathIn(use.Get("of"), use.parent), use.context);
    });
  } else {
    use.context.Defer(BuildStage::kConnections, [use] { AddRule(use); });
  }
  return &use.parent;
}

}  // namespace

std::vector<PlacedFaultRule> FaultRulesOf(const FrameworkElement& application) {
  const auto* const rules = application.FindAnnotation<FaultRules>();
  return rules != nullptr ? rules->rules : std::vector<PlacedFaultRule>{};
}

XmlTag internal::OnFaultTag() {
  return {.name = "on_fault",
          .summary = "what happens when a module has thrown and has been stopped",
          .parents = {"application", "group"},
          .attributes = {{.name = "of",
                          .kind = AttributeKind::kPath,
                          .required = true,
                          .summary = "a module, or a group of which any module may fail",
                          .names_element = true},
                         {.name = "action",
                          .kind = AttributeKind::kChoice,
                          .choices = {"stop_application"}},
                         {.name = "set",
                          .kind = AttributeKind::kPath,
                          .summary = "a parameter that may be set at run time",
                          .names_element = true},
                         {.name = "value", .summary = "what it is set to"}},
          .handle = HandleOnFault};
}

}  // namespace runnel
