#pragma once

#include <functional>
#include <string>
#include <utility>

#include "core/base/retry.h"
#include "core/plugin/plugin_registry.h"

namespace runnel {

/// A plugin that has been loaded anew, until it is known whether it does.
class PluginReload {
 public:
  PluginReload(PluginRegistry& registry, std::string plugin, std::function<void()> back)
      : registry_(&registry), plugin_(std::move(plugin)), back_(std::move(back)) {}
  ~PluginReload() { PutBack(); }
  PluginReload(PluginReload&& other) noexcept
      : registry_(other.registry_),
        plugin_(std::move(other.plugin_)),
        back_(std::exchange(other.back_, nullptr)) {}
  PluginReload& operator=(PluginReload&&) = delete;

  /// It does: what the library of before had registered is forgotten.
  void Keep() noexcept { back_ = nullptr; }
  /// Everything is registered as before.
  void PutBack() noexcept {
    if (!back_) return;
    Retry([this] { (void)registry_->SetAside(plugin_); });
    Retry(std::exchange(back_, nullptr));
  }

 private:
  PluginRegistry* registry_;
  std::string plugin_;
  std::function<void()> back_;
};

}  // namespace runnel
