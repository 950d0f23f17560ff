#include "plugins/inspector/internal/catalogue.h"

#include <algorithm>
#include <array>
#include <functional>
#include <mutex>
#include <optional>

#include "core/base/nearest_name.h"
#include "core/element/configurable.h"
#include "core/plugin/module_type_name.h"
#include "core/port/path_search.h"
#include "core/port/port.h"
#include "core/types/type_info.h"
#include "plugins/inspector/element_json.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

/// Of a TypeKind, in their order.
constexpr std::array<const char*, 6> kKindNames{"opaque",    "leaf",     "enumeration",
                                                "structure", "sequence", "matrix"};

void AppendField(const FieldInfo& field, std::string& text) {
  JsonObject object(text);
  object.Add("name", field.name).Add("type", field.type->name());
  object.Add("unit", field.unit).Add("description", field.description);
}

void AppendType(const TypeInfo* type, std::string& text) {
  JsonObject json(text);
  json.Add("name", type->name()).Add("kind", kKindNames[static_cast<std::size_t>(type->kind())]);
  json.AddTextOrNull("meaning", type->semantic_tag());
  if (type->kind() == TypeKind::kStructure) {
    AppendList(type->fields(), json.Key("fields"), AppendField);
  }
  if (type->kind() == TypeKind::kEnumeration) {
    AppendList(
        type->enumerators(), json.Key("values"),
        [](const EnumeratorInfo& each, std::string& to) { AppendJsonString(each.name, to); });
  }
  if (type->kind() == TypeKind::kSequence || type->kind() == TypeKind::kMatrix) {
    json.Add("element", type->elements().type->name());
  }
}

void AppendPort(const Port* port, std::string& text) {
  JsonObject object(text);
  object.Add("name", port->name());
  object.Add("direction", port->direction() == Port::Direction::kInput ? "input" : "output");
  object.Add("type", port->type().name()).Add("required", port->is_required());
  object.Add("description", port->description());
}

struct ParameterOfType {
  std::string name;
  const Configurable* parameter;
};

void AppendParameter(const ParameterOfType& each, std::string& text) {
  const ConfigurableInfo& info = each.parameter->info();
  JsonObject object(text);
  object.Add("name", each.name).Add("type", each.parameter->type().name());
  object.Add("unit", info.unit).Add("default", info.default_value);
  object.AddOrNull("minimum", info.minimum).AddOrNull("maximum", info.maximum);
  object.Add("description", info.description);
}

CatalogueItemPort ItemOf(const Port& port) {
  return {port.name(), port.direction() == Port::Direction::kInput, port.type().name()};
}

// `module`: one that has been made, or why none can be.
CatalogueItem Describe(const ModuleType& type, const Result<UnlistedElement>& module) {
  std::vector<const Port*> ports;
  std::vector<ParameterOfType> parameters;
  CatalogueItem item{type.name, type.summary, {}, {}};
  if (module) {
    for (const Port* port : PortsOf(**module)) {
      ports.push_back(port);
      item.ports.push_back(ItemOf(*port));
    }
    for (const ConfigurableElement& each : ConfigurablesOf(**module)) {
      parameters.push_back({each.element->name(), each.configurable});
    }
  }
  JsonObject json(item.json);
  json.Add("type", type.name).Add("summary", type.summary).Add("plugin", type.plugin);
  AppendList(ports, json.Key("ports"), AppendPort);
  AppendList(parameters, json.Key("parameters"), AppendParameter);
  if (!module) json.Add("problem", module.error().ToString());
  return item;
}

// Nothing if the type has just gone.
std::optional<CatalogueItem> Look(Runtime& runtime, const ModuleRegistry& modules,
                                  const std::string& name) {
  std::optional<UnlistedElement> made;
  std::optional<CatalogueItem> item;
  {
    const std::lock_guard lock(runtime.structure_mutex());
    const ModuleType* const type = modules.Find(name);
    if (type == nullptr) return {};
    auto module = modules.Make(name, {runtime.root(), "module", false});
    if (module) {
      if (auto whole = Runtime::Construct(**module); !whole) module = whole.error();
    }
    item = Describe(*type, module);
    if (!module) return item;
    made = std::move(*module);
  }
  runtime.Destroy(std::move(*made));
  return item;
}

// A module's connected ports, those of its other faces included.
std::vector<CatalogueItemPort> ConnectedPorts(FrameworkElement& module) {
  std::vector<CatalogueItemPort> ports;
  module.Visit([&](FrameworkElement& element) {
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr || (port->outgoing().empty() && port->incoming().empty())) return;
    ports.push_back(ItemOf(*port));
  });
  return ports;
}

}  // namespace

Catalogue MakeCatalogue(Runtime& runtime, const ModuleRegistry& modules) {
  Catalogue catalogue;
  std::vector<std::string> names;
  {
    const std::lock_guard lock(runtime.structure_mutex());
    names = NamesOf(modules.All(), &ModuleType::name);
  }
  for (const std::string& name : names) {
    if (auto item = Look(runtime, modules, name)) catalogue.modules.push_back(std::move(*item));
  }
  JsonObject json(catalogue.message);
  json.Add("op", "catalogue");
  AppendList(catalogue.modules, json.Key("modules"),
             [](const CatalogueItem& item, std::string& text) { text += item.json; });
  AppendList(RegisteredTypes(), json.Key("types"), AppendType);
  return catalogue;
}

std::uint64_t RegistryFingerprint(const ModuleRegistry& modules) {
  std::uint64_t hash = 1;
  for (const ModuleType* type : modules.All()) {
    hash = hash * 31 + std::hash<std::string>{}(type->name);
    hash = hash * 31 + std::hash<const void*>{}(type);  // made anew when its plugin is loaded anew
  }
  return hash;
}

Result<std::string> CompatibleTypes(Runtime& runtime, const Catalogue& catalogue,
                                    const std::string& path) {
  std::vector<CatalogueItemPort> connected;
  std::string own_type;
  {
    const std::lock_guard lock(runtime.structure_mutex());
    const auto found = runtime.root().Find(path);
    if (!found) {
      Error error = found.error();
      error.path = path;
      return error;
    }
    if (!IsModule(**found)) return Error{.message = "this is not a module", .path = path};
    connected = ConnectedPorts(**found);
    own_type = FindModuleType(**found);
  }
  struct Candidate {
    const CatalogueItem* item;
    std::vector<std::string> lost;
  };
  std::vector<Candidate> candidates;
  for (const CatalogueItem& item : catalogue.modules) {
    if (item.type == own_type) continue;
    Candidate candidate{&item, {}};
    for (const CatalogueItemPort& port : connected) {
      if (std::ranges::count(item.ports, port) == 0) candidate.lost.push_back(port.name);
    }
    const bool is_stranger = !connected.empty() && candidate.lost.size() == connected.size();
    if (!is_stranger && !connected.empty()) candidates.push_back(std::move(candidate));
  }
  std::ranges::stable_sort(candidates, {}, [](const Candidate& each) { return each.lost.size(); });
  std::string text;
  AppendList(candidates, text, [](const Candidate& each, std::string& to) {
    JsonObject json(to);
    json.Add("type", each.item->type).Add("summary", each.item->summary);
    AppendList(each.lost, json.Key("lost"), AppendJsonString);
  });
  return text;
}

}  // namespace runnel::internal
