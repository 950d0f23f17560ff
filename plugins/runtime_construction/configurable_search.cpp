#include "plugins/runtime_construction/configurable_search.h"

#include "plugins/runtime_construction/path_walk.h"

namespace runnel {

namespace {

ConfigurableElement AsConfigurable(FrameworkElement& element) {
  return {&element, dynamic_cast<Configurable*>(&element)};
}

}  // namespace

ConfigurableElement SearchConfigurable(const PathUse& use, BuildContext& context) {
  const PathWalk walk(use);
  if (walk.missing().empty()) {
    const auto found = AsConfigurable(walk.at());
    if (!found) walk.Report({.message = walk.at().path() + " cannot be set"}, context);
    return found;
  }
  const bool may_be_short = walk.at().kind() == ElementKind::kModule && walk.misses_only_the_last();
  if (!may_be_short) {
    walk.ReportMissing(ChildNames(walk.at()), context);
    return {};
  }
  std::vector<std::string> names;
  for (const ConfigurableElement& each : ConfigurablesOf(walk.at())) {
    if (each.element->name() == walk.missing()) return each;
    names.push_back(each.element->name());
  }
  walk.ReportMissing(names, context);
  return {};
}

}  // namespace runnel
