#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/plugin/plugin_registry.h"

namespace runnel::test {

/// A registry that the application offers and the core does not know.
class TagRegistry final : public OfferedRegistry {
 public:
  void Add(const std::string& tag, const std::string& plugin) { plugin_of[tag] = plugin; }
  std::function<void()> SetAside(std::string_view plugin) override {
    std::map<std::string, std::string> removed;
    std::erase_if(plugin_of, [&](const auto& entry) { return entry.second == plugin && removed.insert(entry).second; });
    return [this, removed] { plugin_of.insert(removed.begin(), removed.end()); };
  }
  void set_plugin(const std::string& plugin) override { plugins_told.push_back(plugin); }

  std::map<std::string, std::string> plugin_of;
  std::vector<std::string> plugins_told;
};

}  // namespace runnel::test
