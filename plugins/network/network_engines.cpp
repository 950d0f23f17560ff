#include "plugins/network/network_engines.h"

#include <utility>

#include "core/base/nearest_name.h"

namespace runnel {

namespace {

// Of the process, as libraries are: an engine may be shared by the applications in it.
WireEngines& Engines() {
  static WireEngines engines;
  return engines;
}

}  // namespace

Result<std::shared_ptr<WireEngine>> FindWireEngine(const std::string& name, PluginManager& plugins) {
  const std::string plugin = "wire_" + name;
  if (auto known = Engines().Find(plugin)) return known;
  plugins.registry().Offer(Engines());
  if (const auto loaded = plugins.Load(plugin); !loaded) {
    Error error = loaded.error().WithContext("the network's engine '" + name + "' is not installed");
    error.hint = NearestNameHint(name, std::vector<std::string>{"cyclone", "fast"});
    if (name == "cyclone") error.hint = "install Cyclone DDS (cyclonedds-dev), and build Runnel again";
    if (name == "fast") error.hint = "install Fast DDS (libfastrtps-dev), and build Runnel again";
    return error;
  }
  if (auto loaded = Engines().Find(plugin)) return loaded;
  return Error{.message = "the plugin '" + plugin + "' has no engine for networks"};
}

void AddWireEngine(const std::string& name, std::shared_ptr<WireEngine> engine) {
  Engines().set_plugin("wire_" + name);
  Engines().Add(std::move(engine));
}

}  // namespace runnel
