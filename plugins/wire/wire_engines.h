#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/plugin/plugin_registry.h"
#include "plugins/wire/wire.h"

namespace runnel {

/// The engines that plugins bring, each under its plugin's name:
///
///     RUNNEL_PLUGIN(wire_cyclone, registry) {
///       if (auto* engines = registry.Find<WireEngines>()) engines->Add(MakeCyclone());
///     }
///
/// Threads: not thread-safe. An engine that somebody has stays.
class WireEngines final : public OfferedRegistry {
 public:
  void Add(std::shared_ptr<WireEngine> engine) { engines_[plugin_] = std::move(engine); }
  /// nullptr if the plugin has none.
  [[nodiscard]] std::shared_ptr<WireEngine> Find(std::string_view plugin) const {
    const auto found = engines_.find(plugin);
    return found == engines_.end() ? nullptr : found->second;
  }

  std::function<void()> SetAside(std::string_view plugin) override {
    const auto found = engines_.find(plugin);
    if (found == engines_.end()) return [] {};
    // All memory comes before it is taken out.
    const auto aside = std::make_shared<Engines::node_type>();
    std::function<void()> back = [this, aside] { engines_.insert(std::move(*aside)); };
    *aside = engines_.extract(found);
    return back;
  }
  void set_plugin(const std::string& plugin) override { plugin_ = plugin; }

 private:
  using Engines = std::map<std::string, std::shared_ptr<WireEngine>, std::less<>>;
  Engines engines_;
  std::string plugin_;
};

}  // namespace runnel
