// Setting parameters, those of groups included.

#include <memory>
#include <utility>

#include "core/element/configurable.h"
#include "core/module/group_parameter.h"
#include "core/plugin/module_type_name.h"
#include "core/types/type_info.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

namespace {

// What the parameter is to be set to; one that it accepts.
Result<std::shared_ptr<const void>> ValueIn(const SetParameter& change,
                                            const Configurable& parameter) {
  if (!change.object) return parameter.Parse(change.value);
  if (change.type != &parameter.type()) {
    return Error{.message =
                     "a " + parameter.type().name() + " cannot be set to a " + change.type->name()};
  }
  if (auto good = parameter.Check(change.object.get()); !good) return good.error();
  return change.object;
}

}  // namespace

Result<void> Plan::Check(const SetParameter& change) {
  const auto found = overlay_.Find(change.path, PathKind::kParameter);
  if (!found) return found.error();
  auto* const parameter = dynamic_cast<Configurable*>(*found);
  if (parameter == nullptr) {
    return Error{.message = (*found)->path() + " is not a parameter", .path = (*found)->path()};
  }
  if (const auto* const group = dynamic_cast<const GroupParameter*>(*found)) {
    return CheckAll(*group, change);
  }
  const bool is_settled =
      parameter->info().is_static && (*found)->life_cycle() == LifeCycle::kReady;
  const auto value = ValueIn(change, *parameter);
  if (!value) {
    Error error = value.error();
    if (error.path.empty()) error.path = (*found)->path();
    return error;
  }
  if (is_settled) return CheckStatic(**found, *parameter, value->get());
  Concern(**found);
  auto before = std::make_shared<std::shared_ptr<const void>>();
  steps_.push_back({[parameter, before, value = *value] {
                      *before = parameter->Value();
                      return parameter->SetFrom(value.get());
                    },
                    [parameter, before] {
                      if (*before) (void)parameter->SetFrom(before->get());
                    },
                    [parameter, path = (*found)->path()](auto&) -> ChangeSet {
                      // The module has been made by this change set, and goes as a whole.
                      if (parameter->info().is_static) return {};
                      return {SetParameter{path, parameter->ToText()}};
                    }});
  return {};
}

// What stands for others is set by setting them, each as its kind is set.
Result<void> Plan::CheckAll(const GroupParameter& group, const SetParameter& change) {
  const auto targets = group.Find();
  if (targets.empty()) {
    return Error{.message = "nothing is there any more that could be set by it",
                 .path = group.path()};
  }
  for (const ConfigurableElement& each : targets) {
    SetParameter one{each.element->path(), change.value, change.object, change.type};
    if (change.object && change.type != &each.configurable->type()) {
      one.value = runnel::ToText(*change.type, change.object.get());
      one.object.reset();
    }
    if (auto set = Check(one); !set) return set;
  }
  return {};
}

// The module is made anew by its own type, and keeps what fits: connections of ports that it has no more are cut.
Result<void> Plan::CheckStatic(const FrameworkElement& element, const Configurable& parameter,
                               const void* value) {
  const FrameworkElement* const module = FindModuleAround(element);
  const std::string type = module != nullptr ? FindModuleType(*module) : "";
  if (type.empty()) {
    return Error{.message = "can be set only before its module is ready",
                 .path = element.path(),
                 .hint = "its module was made by code, of a class that no change can make anew"};
  }
  const std::string text = runnel::ToText(parameter.type(), value);
  if (text == parameter.ToText()) return {};
  return CheckReplacement({module->path(), type, {{element.name(), text}}}, Misfits::kAreCut);
}

}  // namespace runnel::internal
