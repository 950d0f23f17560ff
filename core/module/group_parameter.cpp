#include "core/module/group_parameter.h"

#include <mutex>

#include "core/element/runtime.h"
#include "core/types/text_format.h"
#include "core/types/type_of.h"

namespace runnel {

GroupParameter::GroupParameter(const Placement& placement, std::vector<std::string> targets, std::string description)
    : FrameworkElement(placement, ElementKind::kParameter),
      targets_(std::move(targets)),
      type_(&TypeOf<std::string>()),
      info_{.unit = "", .bounds = "", .default_value = "", .description = std::move(description)} {}

void GroupParameter::Add(std::string target) {
  targets_.push_back(std::move(target));
  // One that is static may have been added.
  has_looked_.store(false, std::memory_order_relaxed);
}

void GroupParameter::LookAtFirst() const {
  // acquire: pairs with the release below: what was seen is there.
  if (has_looked_.load(std::memory_order_acquire)) return;
  const std::lock_guard lock(runtime().structure_mutex());
  const auto found = Find();
  if (found.empty() || has_looked_.load(std::memory_order_relaxed)) return;
  const std::string description = info_.description;
  type_ = &found.front().configurable->type();
  info_ = found.front().configurable->info();
  if (!description.empty()) info_.description = description;
  for (const ConfigurableElement& each : found) {
    info_.is_static = info_.is_static || each.configurable->info().is_static;
  }
  has_looked_.store(true, std::memory_order_release);
}

std::vector<ConfigurableElement> GroupParameter::Find() const {
  std::vector<ConfigurableElement> found;
  for (const std::string& target : targets_) {
    const auto element = PathSearch(*parent()).Find(target, PathKind::kParameter);
    auto* const parameter = element ? dynamic_cast<Configurable*>(*element) : nullptr;
    if (parameter != nullptr && parameter != this) found.push_back({*element, parameter});
  }
  return found;
}

Result<std::shared_ptr<const void>> GroupParameter::Parse(std::string_view text) const {
  const auto found = Find();
  if (found.empty()) {
    return Error{.message = "nothing is there any more that could be set by it", .path = path()};
  }
  for (const ConfigurableElement& each : found) {
    if (auto good = each.configurable->CheckText(text); !good) return good.error().WithPath(each.element->path());
  }
  const Configurable& first = *found.front().configurable;
  auto value = first.Parse(text);
  if (!value || &first.type() == &type()) return value;
  // The first one has been replaced by one of another type.
  const std::shared_ptr<void> own = type().Make();
  if (auto read = runnel::SetFromText(type(), text, own.get()); !read) return read.error();
  return std::shared_ptr<const void>(own);
}

Result<void> GroupParameter::Check(const void* value) const {
  for (const ConfigurableElement& each : Find()) {
    // Nobody keeps it.
    const auto good = each.configurable->ConvertedFrom({&type()}, {std::shared_ptr<const void>(), value});
    if (!good) return good.error();
  }
  return {};
}

Configurable::Values GroupParameter::values() const {
  const auto found = Find();
  if (found.empty()) return {type_, "", {Value()}};
  Values first = found.front().configurable->values();
  if (first.type == &type()) return first;
  // It has been replaced by one of another type.
  const std::shared_ptr<void> own = type().Make();
  (void)runnel::SetFromText(*type_, runnel::ToText(*first.type, first.own.value.get()), own.get());
  return {type_, first.unit, {own, first.own.given, first.own.settings}};
}

Result<void> GroupParameter::Put(const Own& own) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (auto good = Check(own.value.get()); !good) return good;
  const auto found = Find();
  if (found.empty()) {
    return Error{.message = "nothing is there any more that could be set by it", .path = path()};
  }
  std::vector<std::pair<Configurable*, Own>> before;
  for (const ConfigurableElement& each : found) {
    const auto wanted = each.configurable->ConvertedFrom({&type()}, own.value);
    before.emplace_back(each.configurable, each.configurable->own());
    auto set = wanted ? each.configurable->Put({*wanted, own.given}) : Result<void>(wanted.error());
    if (set) continue;
    before.pop_back();
    for (const auto& [parameter, old] : before) (void)parameter->Put(old);
    return set;
  }
  return {};
}

std::shared_ptr<void> GroupParameter::Value() const {
  const auto found = Find();
  std::shared_ptr<void> own = type().Make();
  if (found.empty()) return own;
  const Configurable& first = *found.front().configurable;
  if (&first.type() == &type()) return first.Value();
  (void)runnel::SetFromText(*type_, first.ToText(), own.get());
  return own;
}

}  // namespace runnel
