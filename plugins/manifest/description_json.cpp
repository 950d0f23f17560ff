#include "plugins/manifest/description_json.h"

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

}  // namespace runnel
