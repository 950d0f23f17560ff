// Changes that extensions carry out.

#include "core/element/runtime.h"
#include "plugins/structure/extension_changes.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

Result<void> Plan::Check(const ExtensionChange& change) {
  const auto* const known = runtime_.root().FindAnnotation<ExtensionChanges>();
  const auto found = known != nullptr ? known->verbs.find(change.verb) : decltype(known->verbs.find(""))();
  if (known == nullptr || found == known->verbs.end()) {
    return Error{.message = "nothing of the application can '" + change.verb + "'",
                 .hint = "what is offered and taken needs <network/> in its file"};
  }
  auto step = found->second(change, [this](const std::string& path, PathKind kind) { return overlay_.FindPort(path, kind); });
  if (!step) return step.error();
  for (const runnel::Change& each : step->changes) {
    const auto checked = std::visit([this](const auto& one) { return Check(one); }, each);
    if (!checked) return checked;
  }
  if (!step->apply) return {};
  steps_.push_back({step->apply, step->undo, [inverse = step->inverse](auto&) { return inverse(); }});
  return {};
}

void Plan::MoveExtensions(const FrameworkElement& renamed, const std::string& name) {
  const auto* const known = runtime_.root().FindAnnotation<ExtensionChanges>();
  if (known == nullptr || !known->rename) return;
  const ExtensionStep step = known->rename(renamed.path(), renamed.parent()->path() + "/" + name);
  if (step.apply) steps_.push_back({step.apply, step.undo, [](auto&) { return ChangeSet(); }});
}

}  // namespace runnel::internal
