#include <algorithm>
#include <array>
#include <functional>
#include <mutex>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "core/port/port.h"
#include "core/types/type_info.h"
#include "plugins/inspector/internal/inspection.h"
#include "plugins/manifest/plugin_manifest.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

/// Of a TypeKind, in their order.
constexpr std::array<const char*, 6> kKindNames{"opaque", "leaf", "enumeration", "structure", "sequence", "matrix"};

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
    AppendList(type->enumerators(), json.Key("values"),
               [](const EnumeratorInfo& each, std::string& to) { AppendJsonString(each.name, to); });
  }
  if (type->kind() == TypeKind::kSequence || type->kind() == TypeKind::kMatrix) {
    json.Add("element", type->elements().type->name());
  }
}

// A module's connected ports, those of its other faces included.
std::vector<ModuleDescription::Port> ConnectedPorts(FrameworkElement& module) {
  std::vector<ModuleDescription::Port> ports;
  for (const Port* port : PortsOf(module)) {
    if (port->outgoing().empty() && port->incoming().empty()) continue;
    ports.push_back({.name = port->name(),
                     .group = {},
                     .is_input = port->direction() == Port::Direction::kInput,
                     .type = port->type().name(),
                     .description = {}});
  }
  return ports;
}

}  // namespace

Catalogue MakeCatalogue(const ServedApplication& application) {
  Catalogue catalogue;
  std::vector<std::string> names;
  {
    const std::lock_guard lock(application.runtime.structure_mutex());
    names = NamesOf(application.modules.All(), &ModuleType::name);
  }
  ModuleDescriber describer(application.runtime, application.modules, application.hooks.library_of);
  for (const std::string& name : names) {
    if (auto module = describer.Describe(name)) catalogue.modules.push_back(std::move(*module));
  }
  JsonObject json(catalogue.message);
  json.Add("op", "catalogue");
  AppendList(catalogue.modules, json.Key("modules"),
             [](const ModuleDescription& module, std::string& text) { AppendJson(module, text); });
  AppendList(RegisteredTypes(), json.Key("types"), AppendType);
  return catalogue;
}

std::uint64_t RegistryFingerprint(const ModuleRegistry& modules) {
  std::uint64_t hash = RegisteredTypes().size();  // described when their ports are there
  for (const ModuleType* type : modules.All()) {
    hash = hash * 31 + std::hash<std::string>{}(type->name);
    hash = hash * 31 + std::hash<const void*>{}(type);  // made anew when its plugin is loaded anew
  }
  return hash;
}

Result<std::string> CompatibleTypes(Runtime& runtime, const Catalogue& catalogue, const std::string& path) {
  std::vector<ModuleDescription::Port> connected;
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
    const ModuleDescription* item;
    std::vector<std::string> lost;
  };
  std::vector<Candidate> candidates;
  for (const ModuleDescription& item : catalogue.modules) {
    Candidate candidate{&item, {}};
    for (const ModuleDescription::Port& port : connected) {
      const auto is_it = [&](const ModuleDescription::Port& each) {
        return each.name == port.name && each.is_input == port.is_input && each.type == port.type;
      };
      if (std::ranges::none_of(item.ports, is_it)) candidate.lost.push_back(port.name);
    }
    const bool is_stranger = !connected.empty() && candidate.lost.size() == connected.size();
    const bool is_own = item.type == own_type;
    if (is_own || (!is_stranger && !connected.empty())) candidates.push_back(std::move(candidate));
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
