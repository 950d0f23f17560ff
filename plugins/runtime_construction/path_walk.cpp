#include "plugins/runtime_construction/path_walk.h"

#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "plugins/runtime_construction/name_check.h"

namespace runnel {

PathWalk::PathWalk(const PathUse& use)
    : use_(use), at_(IsAbsolutePath(use.path) ? &use.base.runtime().root() : &use.base) {
  const std::vector<std::string_view> names = SplitPath(use.path);
  for (const std::string_view& name : names) {
    FrameworkElement* next = at_->FindChild(name);
    if (name == ".") next = at_;
    if (name == "..") next = at_->parent();
    if (next == nullptr) {
      missing_ = name;
      misses_only_the_last_ = &name == &names.back();
      return;
    }
    at_ = next;
  }
}

void PathWalk::ReportMissing(const std::vector<std::string>& candidates,
                             BuildContext& context) const {
  if (!context.IsNews(*at_, missing_, candidates)) return;
  Report({.message = "there is no '" + std::string(missing_) + "' in " + at_->path(),
          .hint = NearestNameHint(missing_, candidates)},
         context);
}

void PathWalk::Report(Error error, BuildContext& context) const {
  context.Report(std::move(error), use_.position, use_.base);
}

FrameworkElement* SearchElement(const PathUse& use, BuildContext& context) {
  const PathWalk walk(use);
  if (walk.missing().empty()) return &walk.at();
  walk.ReportMissing(ChildNames(walk.at()), context);
  return nullptr;
}

std::vector<std::string> ChildNames(const FrameworkElement& element) {
  std::vector<std::string> names;
  for (const FrameworkElement* child : element.children()) {
    if (!IsStandIn(*child)) names.push_back(child->name());
  }
  return names;
}

}  // namespace runnel
