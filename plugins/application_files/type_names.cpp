#include "plugins/application_files/type_names.h"

#include <algorithm>
#include <thread>

#include "core/base/nearest_name.h"
#include "core/element/runtime.h"
#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "plugins/manifest/plugin_manifest.h"

namespace runnel {

namespace {

std::string LastPart(std::string_view type) {
  return std::string(type.substr(type.rfind('/') + 1));  // npos + 1 is 0
}

// Of "sensors/laser" and "laser": 'adaptors/laser' or 'simulation/laser'. "" if none ends alike.
std::string TypesWithNearestEnd(std::string_view type, const std::vector<std::string>& known) {
  const std::vector<std::string> ends = NamesOf(known, LastPart);
  const std::string nearest = NearestName(LastPart(type), ends);
  std::string types;
  for (std::size_t i = 0; i < known.size() && !nearest.empty(); ++i) {
    if (ends[i] == nearest) types += (types.empty() ? "'" : " or '") + known[i] + "'";
  }
  return types;
}

std::string ModuleTypeHint(std::string_view type, const PluginManager& plugins) {
  const std::string family(type.substr(0, std::min(type.find('/'), type.size())));
  if (std::ranges::count(plugins.Available(), family) > 0 && !plugins.IsLoaded(family)) {
    return "add <load plugin=\"" + family + "\"/>";
  }
  const std::vector<std::string> known = ModuleTypeNames(plugins);
  const std::string nearest = NearestName(type, known);
  const std::string meant = nearest.empty() ? TypesWithNearestEnd(type, known) : "'" + nearest + "'";
  if (!meant.empty()) return "did you mean " + meant + "?";
  return "load the plugin that brings it; `runnel modules` lists all types";
}

template <typename... Types>
void MakeKnown() {
  ((void)TypeOf<Types>(), ...);
}

void MakeBuiltinTypesKnown() {
  MakeKnown<bool, std::int8_t, std::int16_t, std::int32_t, std::int64_t, std::uint8_t, std::uint16_t, std::uint32_t,
            std::uint64_t, float, double, std::string, Duration, Time>();
}

bool HasType(const ModuleDescription& module, std::string_view type) {
  return std::ranges::find(module.ports, type, &ModuleDescription::Port::type) != module.ports.end() ||
         std::ranges::find(module.parameters, type, &ModuleDescription::Parameter::type) != module.parameters.end();
}

void MakeSamples(const ModuleRegistry& modules, Runtime& scratch) {
  for (const ModuleType* each : modules.All()) {
    // One that cannot be made here brings no type; if the application asks for it, that is told.
    (void)modules.CreateSample(each->name, scratch.root());
  }
}

// A type is known once a module that has it has been made. Which modules have it, the manifests of plugins say; only
// what none of them says, as types within others, is found by making all.
void MakePortTypeKnown(std::string_view type, const PluginManager& plugins) {
  const ModuleRegistry& modules = plugins.modules();
  std::thread([&] {
    Runtime scratch;
    ModuleDescriber describer(scratch, modules, [&](const std::string& plugin) {
      const auto file = plugins.FindFile(plugin);
      return file ? file->string() : "";
    });
    for (const ModuleType* each : modules.All()) {
      const auto description = describer.Describe(each->name);
      if (!description || !HasType(*description, type)) continue;
      (void)modules.CreateSample(each->name, scratch.root());
      if (FindType(type) != nullptr) return;
    }
    MakeSamples(modules, scratch);
  }).join();
}

}  // namespace

void MakePortTypesKnown(const PluginManager& plugins) {
  MakeBuiltinTypesKnown();
  std::thread([&] {
    Runtime scratch;
    MakeSamples(plugins.modules(), scratch);
  }).join();
}

std::vector<std::string> ModuleTypeNames(const PluginManager& plugins) {
  return NamesOf(plugins.modules().All(), &ModuleType::name);
}

std::vector<std::string> PortTypeNames() { return NamesOf(RegisteredTypes(), &TypeInfo::name); }

Result<void> CheckModuleType(std::string_view type, const PluginManager& plugins) {
  const auto known = plugins.modules().Get(type);
  if (known) return {};
  return Error{.message = known.error().message, .hint = ModuleTypeHint(type, plugins)};
}

Result<void> CheckPortType(std::string_view type, const PluginManager& plugins) {
  if (FindType(type) != nullptr) return {};
  MakeBuiltinTypesKnown();
  if (FindType(type) != nullptr) return {};
  MakePortTypeKnown(type, plugins);
  if (FindType(type) != nullptr) return {};
  const std::string nearest = NearestName(type, PortTypeNames());
  return Error{.message = "there is no type '" + std::string(type) + "'",
               .hint = nearest.empty() ? "types come with the plugins whose modules have ports of "
                                         "them; is a <load> missing?"
                                       : "did you mean '" + nearest + "'?"};
}

}  // namespace runnel
