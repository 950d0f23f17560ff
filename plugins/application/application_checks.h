#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/element/framework_element.h"
#include "core/plugin/plugin_registry.h"

namespace runnel {

/// What a check of a whole application has before it.
struct ApplicationCheckUse {
  FrameworkElement& application;  ///< constructed and connected, not ready
  Diagnostics& diagnostics;       ///< what it finds is added
  std::string model_file = {};    ///< where it writes the model that it checks, if it has one; "": nowhere
};

/// Checks of whole applications that plugins bring, for `runnel check`: what goes beyond single tags, and takes its time.
///
///     RUNNEL_PLUGIN(behaviours, registry) {
///       if (auto* checks = registry.Find<ApplicationChecks>()) checks->Add(CheckNetwork);
///     }
///
/// Threads: not thread-safe.
class ApplicationChecks final : public OfferedRegistry {
 public:
  using Check = std::function<void(const ApplicationCheckUse& use)>;

  void Add(Check check);
  std::function<void()> SetAside(std::string_view plugin) override;
  void set_plugin(const std::string& plugin) override { plugin_ = plugin; }

  /// All of them, under the structure lock. What one throws is an error.
  void Run(const ApplicationCheckUse& use) const;

 private:
  struct PluginCheck {
    std::string plugin;
    Check check;
  };
  std::vector<PluginCheck> checks_;
  std::string plugin_;
};

}  // namespace runnel
