#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

// By its path, for its module may have been replaced meanwhile.
void SetParameterAt(const std::string& path, const std::string& value, Runtime& runtime) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = runtime.root().Find(path);
  if (!found) throw ElementError(found.error());
  auto* const parameter = dynamic_cast<Configurable*>(*found);
  if (parameter == nullptr) {
    throw ElementError({.message = "cannot be set by a fault rule", .path = path});
  }
  if (auto set = parameter->SetFromText(value); !set) throw ElementError(set.error());
}

void AddRule(const TagUse& use) {
  FaultRule rule;
  const FrameworkElement* const of = SearchElement(PathIn(use.Get("of"), use.parent), use.context);
  const XmlAttribute* const set = use.Find("set");
  const XmlAttribute* const value = use.Find("value");
  if (set != nullptr) {
    if (value == nullptr) return;
    const FrameworkElement* const target = SearchSettable(*set, *value, use.parent, use.context);
    if (target == nullptr) return;
    rule.call = [path = target->path(), text = value->value, &runtime = use.context.runtime()](
                    const Fault&) { SetParameterAt(path, text, runtime); };
  }
  if (of == nullptr) return;
  rule.of = of->path();
  internal::RunRulesAround(use.parent).fault_rules.push_back(std::move(rule));
}

void AddReaction(const TagUse& use) {
  const FrameworkElement* const of = SearchElement(PathIn(use.Get("of"), use.parent), use.context);
  Reaction reaction = internal::ReadReaction(use.xml, use.parent, use.context);
  if (of == nullptr) return;
  internal::RunRulesAround(use.parent).fault_reactions.push_back({of->path(), std::move(reaction)});
}

FrameworkElement* HandleOnFault(const TagUse& use) {
  const bool acts = use.Find("action") != nullptr;
  const bool sets = use.Find("set") != nullptr;
  const bool has_value = use.Find("value") != nullptr;
  const bool has_tags = !use.xml.children().empty();
  if (acts + sets + has_tags != 1) {
    use.Report({.message = "<on_fault> must say one thing that is to be done",
                .hint = "write either action=\"stop_application\" or set=\"…\" value=\"…\""},
               use.xml.position());
  }
  if (sets != has_value) {
    use.Report(
        {.message = sets ? "<on_fault> does not say to which value" : "'value' needs a 'set'",
         .hint = sets ? "add value=\"…\"" : "add set=\"…\", or leave out value"},
        use.xml.position());
  }
  if (has_tags) {
    use.context.Defer(BuildStage::kChecks, [use] { AddReaction(use); });
  } else {
    use.context.Defer(BuildStage::kConnections, [use] { AddRule(use); });
  }
  return &use.parent;
}

}  // namespace

XmlTag OnFaultTag() {
  return {.name = "on_fault",
          .summary = "what happens when a module has thrown and has been stopped",
          .parents = {"application", "group"},
          .attributes = {PathRule("of", true, "a module, or a group of which any module may fail"),
                         {.name = "action",
                          .kind = AttributeKind::kChoice,
                          .choices = {"stop_application"}},
                         PathRule("set", false, "a parameter that may be set at run time"),
                         {.name = "value", .summary = "what it is set to"}},
          .handle = HandleOnFault};
}

}  // namespace runnel
