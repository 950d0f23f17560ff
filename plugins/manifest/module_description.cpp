#include "plugins/manifest/module_description.h"

#include <mutex>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/configurable.h"
#include "core/paths/path_search.h"
#include "core/port/port.h"
#include "core/types/type_info.h"
#include "plugins/values/json_writer.h"

namespace runnel {

namespace {

void AppendPort(const ModuleDescription::Port& port, std::string& json) {
  JsonObject object(json);
  object.Add("name", port.name).Add("group", port.group);
  object.Add("direction", port.is_input ? "input" : "output").Add("type", port.type);
  object.Add("required", port.is_required).Add("description", port.description);
}

void AppendParameter(const ModuleDescription::Parameter& each, std::string& json) {
  JsonObject object(json);
  object.Add("name", each.name).Add("type", each.type);
  object.Add("unit", each.unit).Add("default", each.default_value);
  object.AddOrNull("minimum", each.minimum).AddOrNull("maximum", each.maximum);
  AppendList(each.choices, object.Key("choices"), AppendJsonString);
  object.Add("static", each.is_static).Add("description", each.description);
}

ModuleDescription::Port Describe(const Port& port) {
  return {.name = port.name(),
          .group = port.parent()->name(),
          .is_input = port.direction() == Port::Direction::kInput,
          .type = port.type().name(),
          .is_required = port.is_required(),
          .description = port.description()};
}

ModuleDescription::Parameter Describe(const ConfigurableElement& each) {
  const ConfigurableInfo& info = each.configurable->info();
  const TypeInfo& type = each.configurable->type();
  return {.name = each.element->name(),
          .type = type.name(),
          .unit = info.unit,
          .default_value = info.default_value,
          .bounds = info.bounds,
          .minimum = info.minimum,
          .maximum = info.maximum,
          .choices = NamesOf(type.enumerators(), &EnumeratorInfo::name),
          .is_static = info.is_static,
          .description = info.description};
}

}  // namespace

void AppendJson(const ModuleDescription& module, std::string& json) {
  JsonObject object(json);
  object.Add("type", module.type).Add("summary", module.summary).Add("plugin", module.plugin);
  AppendList(module.ports, object.Key("ports"), AppendPort);
  AppendList(module.parameters, object.Key("parameters"), AppendParameter);
  object.AddTextOrNull("problem", module.problem);
}

std::string JsonText(const std::vector<ModuleDescription>& modules) {
  std::string json;
  AppendList(modules, json, AppendJson);
  return json;
}

std::string ModuleDescription::Port::PathInModule() const {
  return group == "input" || group == "output" ? name : group + "/" + name;
}

ModuleDescription DescribeModule(const ModuleType& type, const FrameworkElement& module) {
  ModuleDescription description{.type = type.name, .summary = type.summary, .plugin = type.plugin};
  for (const Port* port : PortsOf(module)) description.ports.push_back(Describe(*port));
  for (const ConfigurableElement& each : ConfigurablesOf(module)) {
    description.parameters.push_back(Describe(each));
  }
  return description;
}

std::optional<ModuleDescription> DescribeByMaking(Runtime& runtime, const ModuleRegistry& modules,
                                                  const std::string& name) {
  std::optional<UnlistedElement> made;
  std::optional<ModuleDescription> description;
  {
    const std::lock_guard lock(runtime.structure_mutex());
    const ModuleType* const type = modules.Find(name);
    if (type == nullptr) return {};
    auto module = modules.Make(name, {runtime.root(), "module", false});
    if (module) {
      if (auto whole = Runtime::Construct(**module); !whole) module = whole.error();
    }
    if (!module) {
      return ModuleDescription{
          .type = type->name, .summary = type->summary, .plugin = type->plugin, .problem = module.error().ToString()};
    }
    description = DescribeModule(*type, **module);
    made = std::move(*module);
  }
  runtime.Destroy(std::move(*made));
  return description;
}

}  // namespace runnel
