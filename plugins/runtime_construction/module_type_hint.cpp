#include "plugins/runtime_construction/module_type_hint.h"

#include <algorithm>
#include <vector>

#include "core/base/nearest_name.h"

namespace runnel {

namespace {

bool Contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string LastPart(std::string_view type) {
  return std::string(type.substr(type.rfind('/') + 1));  // npos + 1 is 0
}

// Of "sensors/laser" and "laser": 'adaptors/laser' or 'simulation/laser'. "" if none ends alike.
std::string TypesWithNearestEnd(std::string_view type, const std::vector<std::string>& known) {
  std::vector<std::string> ends;
  for (const std::string& each : known) ends.push_back(LastPart(each));
  const std::string nearest = NearestName(LastPart(type), ends);
  std::string types;
  for (std::size_t i = 0; i < known.size() && !nearest.empty(); ++i) {
    if (ends[i] == nearest) types += (types.empty() ? "'" : " or '") + known[i] + "'";
  }
  return types;
}

}  // namespace

std::string ModuleTypeHint(std::string_view type, const PluginManager& plugins) {
  const std::string family(type.substr(0, std::min(type.find('/'), type.size())));
  if (Contains(plugins.Available(), family) && !Contains(plugins.loaded(), family)) {
    return "add <load plugin=\"" + family + "\"/>";
  }
  std::vector<std::string> known;
  for (const ModuleType* each : plugins.modules().All()) known.push_back(each->name);
  const std::string nearest = NearestName(type, known);
  const std::string meant =
      nearest.empty() ? TypesWithNearestEnd(type, known) : "'" + nearest + "'";
  if (!meant.empty()) return "did you mean " + meant + "?";
  return "load the plugin that brings it; `runnel modules` lists all types";
}

}  // namespace runnel
