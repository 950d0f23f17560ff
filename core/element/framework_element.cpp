#include "core/element/framework_element.h"

#include <algorithm>
#include <mutex>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/element/runtime.h"

namespace runnel {

namespace internal {
thread_local std::uint64_t made_by_this_thread = 0;  // elements, by which Construct() tells what was made
}

FrameworkElement::FrameworkElement(RootTag, Runtime& runtime)
    : path_("/"), kind_(ElementKind::kRuntime), life_cycle_(LifeCycle::kReady), runtime_(&runtime) {}

FrameworkElement::FrameworkElement(const Placement& placement, ElementKind kind)
    : name_(placement.name),
      path_((placement.parent.parent_ != nullptr ? placement.parent.path_ : "") + "/" + name_),
      kind_(kind),
      parent_(&placement.parent),
      runtime_(parent_->runtime_) {
  const std::lock_guard lock(runtime_->structure_mutex());
  if (const auto name_is_good = CheckElementName(name_); !name_is_good) {
    throw ElementError(name_is_good.error().WithPath(parent_->path()));
  }
  if (placement.is_listed) JoinParent(nullptr);
  id_ = runtime_->NextId();
  ++internal::made_by_this_thread;
}

void FrameworkElement::JoinParent(const FrameworkElement* place) {
  if (parent_->life_cycle_ == LifeCycle::kDeleted) {
    throw ElementError(
        {.message = "cannot create '" + name_ + "' in an element that is being deleted", .path = parent_->path()});
  }
  const auto [entry, is_new] = parent_->children_by_name_.try_emplace(name_, this);
  if (!is_new) {
    throw ElementError({.message = "there is already an element called '" + name_ + "'",
                        .path = parent_->path(),
                        .hint = "choose another name"});
  }
  auto& siblings = parent_->children_;
  try {
    siblings.insert(place == nullptr ? siblings.end() : std::ranges::find(siblings, place), this);
  } catch (...) {
    parent_->children_by_name_.erase(entry);
    throw;
  }
  is_listed_ = true;
}

bool FrameworkElement::IsInTree() const noexcept {
  const FrameworkElement* element = this;
  while (element->parent_ != nullptr && element->is_listed_) element = element->parent_;
  return element == &runtime_->root();
}

FrameworkElement::~FrameworkElement() {
  if (!is_listed_) return;
  const std::lock_guard lock(runtime_->structure_mutex());
  if (life_cycle_ != LifeCycle::kDeleted && IsInTree()) runtime_->NoteChange();
  DestroyOwned();
  // Members of an object above, which outlive this group: a module's parameters.
  for (FrameworkElement* child : children_) {
    child->parent_ = nullptr;
    child->is_listed_ = false;
  }
  LeaveParent();
}

void FrameworkElement::LeaveParent() noexcept {
  std::erase(parent_->children_, this);
  parent_->children_by_name_.erase(name_);
  is_listed_ = false;
}

void FrameworkElement::DestroyOwned() noexcept {
  while (!owned_.empty()) {
    owned_.back()->DestroyOwned();
    owned_.pop_back();  // what was made last goes first
  }
}

FrameworkElement* FrameworkElement::FindChild(std::string_view child_name) const {
  const auto found = children_by_name_.find(child_name);
  return found == children_by_name_.end() ? nullptr : found->second;
}

namespace {

// "planner/twist" for "planner/output/twist": what is in a group of ports or parameters, outputs first.
const FrameworkElement* FindInGroups(const FrameworkElement& at, std::string_view name) {
  const FrameworkElement* found = nullptr;
  for (const FrameworkElement* group : at.children()) {
    if (group->kind() != ElementKind::kPortGroup) continue;
    const FrameworkElement* const inner = group->FindChild(name);
    if (inner != nullptr && (found == nullptr || group->name() == "output")) found = inner;
  }
  return found;
}

// "/robot" for "/application/robot", if there is one application only.
const FrameworkElement* FindInOnlyApplication(const FrameworkElement& root, std::string_view name) {
  const FrameworkElement* only = nullptr;
  for (const FrameworkElement* each : root.children()) {
    if (each->kind() != ElementKind::kGroup || each->name() == "threads") continue;
    if (only != nullptr) return nullptr;
    only = each;
  }
  return only != nullptr ? only->FindChild(name) : nullptr;
}

}  // namespace

Result<FrameworkElement*> FrameworkElement::Find(std::string_view path) const {
  const FrameworkElement* at = this;
  if (IsAbsolutePath(path)) at = &runtime_->root();
  for (const std::string_view part : SplitPath(path)) {
    const FrameworkElement* next = at->FindChild(part);
    if (part == ".") next = at;
    if (part == "..") next = at->parent_;
    if (next == nullptr) {
      next = at->parent_ == nullptr ? FindInOnlyApplication(*at, part) : FindInGroups(*at, part);
    }
    if (next == nullptr) {
      std::vector<std::string> names;
      for (const FrameworkElement* child : at->children_) names.push_back(child->name_);
      return Error{.message = "no '" + std::string(part) + "' in " + at->path(),
                   .path = this->path(),
                   .hint = NearestNameHint(part, names)};
    }
    at = next;
  }
  return const_cast<FrameworkElement*>(at);
}

bool FrameworkElement::IsAtOrBelow(const FrameworkElement& ancestor) const noexcept {
  const FrameworkElement* element = this;
  while (element != nullptr && element != &ancestor) element = element->parent_;
  return element != nullptr;
}

void FrameworkElement::InheritAnnotations(const FrameworkElement& from, Inherit how) {
  for (const auto& [type, annotation] : from.annotations_) {
    auto left = how == Inherit::kAsCopy ? annotation->ForCopy() : annotation->ForReplacement();
    if (left) annotations_[type] = std::move(left);
  }
  for (FrameworkElement* child : children_) {
    if (const FrameworkElement* counterpart = from.FindChild(child->name_)) {
      child->InheritAnnotations(*counterpart, how);
    }
  }
}

void FrameworkElement::Visit(const std::function<void(FrameworkElement&)>& visit) {
  visit(*this);
  // By index: a visitor may add children.
  for (std::size_t i = 0; i < children_.size(); ++i) children_[i]->Visit(visit);
}

}  // namespace runnel
