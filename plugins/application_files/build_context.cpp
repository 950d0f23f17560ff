#include "plugins/application_files/build_context.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/base/nearest_name.h"
#include "core/element/attempt.h"
#include "core/element/element_path.h"
#include "plugins/application_files/type_names.h"

namespace runnel {

namespace {

std::string WithoutPath(std::string text, const std::string& path) {
  for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at)) {
    text.erase(at, path.size());
  }
  return text;
}

}  // namespace

bool BuildContext::Place(Error& error, const SourcePosition& position, const FrameworkElement& element) {
  if (error.position.file.empty()) error.position = position;
  if (error.path.empty()) error.path = element.path();
  const std::string chain = UseChain(error.position.file, element);
  if (chain.empty()) return true;
  const std::string own_path = parts_.FindAround(&element)->group.path();
  const std::string what = PlaceText(error.position) + ":" + WithoutPath(error.message, own_path);
  error.hint += (error.hint.empty() ? "" : "; ") + chain;
  return told_.insert(what).second;
}

void BuildContext::Report(Error error, const SourcePosition& position, const FrameworkElement& element) {
  if (Place(error, position, element)) diagnostics_.Add(std::move(error));
}

void BuildContext::Warn(Error warning, const SourcePosition& position, const FrameworkElement& element) {
  if (Place(warning, position, element)) diagnostics_.AddWarning(std::move(warning));
}

void BuildContext::Attempt(const Cause& cause, const std::function<void()>& action) {
  const Cause outer = std::exchange(cause_, cause);
  try {
    action();
  } catch (...) {
    Report(CaughtError(cause.what, " failed: "), cause.position, *cause.element);
  }
  cause_ = outer;
}

void BuildContext::Defer(BuildStage stage, std::function<void()> action) {
  RUNNEL_CHECK(cause_.element != nullptr, "only what handles a tag can be deferred");
  deferred_[stage].push_back({cause_, std::move(action)});
}

void BuildContext::RunDeferred() {
  while (!deferred_.empty()) {
    auto first = deferred_.extract(deferred_.begin());
    const auto depth = [](const Deferred& each) { return std::ranges::count(each.cause.element->path(), '/'); };
    if (first.key() == BuildStage::kInterfaces) std::ranges::stable_sort(first.mapped(), std::greater(), depth);
    for (const Deferred& each : first.mapped()) Attempt(each.cause, each.action);
  }
}

Result<void> BuildContext::CheckValue(const AttributeRule& rule, std::string_view value) const {
  const bool is_module_type = rule.kind == AttributeKind::kModuleType;
  if (!is_module_type && rule.kind != AttributeKind::kPortType) {
    return CheckAttributeValue(rule, value);
  }
  auto good = is_module_type ? CheckModuleType(value, plugins()) : CheckPortType(value, plugins());
  const bool is_told = good || IsWorthReporting(value, is_module_type ? ModuleTypeNames(plugins()) : PortTypeNames());
  return is_told ? good : Error{};
}

void BuildContext::MarkMissing(const FrameworkElement& parent, const XmlAttribute* name) {
  unfed_.insert(&parent);
  if (name != nullptr && CheckElementName(name->value)) {
    missing_.emplace(&parent, name->value);
  } else {
    incomplete_.insert(&parent);
  }
}

bool BuildContext::IsWhole(const FrameworkElement& element) const {
  const auto is_in_it = [&](const FrameworkElement* each) { return each->IsAtOrBelow(element); };
  return std::ranges::none_of(missing_, [&](const auto& each) { return is_in_it(each.first); }) &&
         std::ranges::none_of(incomplete_, is_in_it) && std::ranges::none_of(unbuilt_, is_in_it);
}

bool BuildContext::IsNews(const FrameworkElement& parent, std::string_view name,
                          const std::vector<std::string>& candidates) const {
  for (const FrameworkElement* at = &parent; at != nullptr; at = at->parent()) {
    if (unbuilt_.contains(at)) return false;
  }
  if (missing_.contains({&parent, std::string(name)})) return false;
  return !incomplete_.contains(&parent) || !NearestName(name, candidates).empty();
}

bool BuildContext::IsUnfedUnnoticed(const Port& input) const {
  return std::ranges::none_of(unfed_, [&](const FrameworkElement* each) {
    if (input.IsAtOrBelow(*each)) return true;
    // An interface port that stayed unconnected leaves what it would have fed unconnected.
    const auto* const port = dynamic_cast<const Port*>(each);
    return port != nullptr && port->is_proxy() && std::ranges::count(port->Sinks(), &input) > 0;
  });
}

bool BuildContext::IsWorthReporting(std::string_view unknown, const std::vector<std::string>& known) const {
  return !plugin_is_missing_ || !NearestName(unknown, known).empty();
}

}  // namespace runnel
