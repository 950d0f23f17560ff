#include "plugins/genom_description/description.h"

#include "plugins/genom_description/component_json.h"

namespace runnel::genom {

std::string DescriptionJson(const Description& description) {
  Layouts layouts;
  const JsonWriter writer(description.problems, layouts);
  Json json;
  json["notice"] = description.notice;
  json["files"] = description.problems.files();
  json["types"] = Json::array();
  for (const Type& each : description.scopes.types()) {
    if (JsonWriter::IsDeclared(each)) json["types"].push_back(writer.Declared(each));
  }
  json["interfaces"] = Json::array();
  json["components"] = Json::array();
  for (const Component& each : description.components) {
    json[each.is_interface ? "interfaces" : "components"].push_back(writer.ComponentJson(each));
  }
  json["masquerades"] = Json::object();
  for (const auto& [name, types] : description.masquerades) {
    for (const auto& [type, text] : types) json["masquerades"][name][type->ShownName()] = text;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace runnel::genom
