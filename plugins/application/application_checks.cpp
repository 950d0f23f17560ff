#include "plugins/application/application_checks.h"

#include <memory>
#include <mutex>
#include <utility>

#include "core/base/exception_text.h"
#include "core/element/runtime.h"

namespace runnel {

void ApplicationChecks::Add(Check check) { checks_.push_back({plugin_, std::move(check)}); }

std::function<void()> ApplicationChecks::SetAside(std::string_view plugin) {
  const auto before = std::make_shared<std::vector<PluginCheck>>(checks_);
  std::function<void()> back = [this, before] { checks_ = *before; };
  std::erase_if(checks_, [&](const PluginCheck& each) { return each.plugin == plugin; });
  return back;
}

void ApplicationChecks::Run(const ApplicationCheckUse& use) const {
  const std::lock_guard lock(use.application.runtime().structure_mutex());
  CheckMotion(use);
  for (const PluginCheck& each : checks_) {
    try {
      each.check(use);
    } catch (...) {
      use.diagnostics.Add({.message = "a check of the plugin '" + each.plugin + "' has failed: " + DescribeException()});
    }
  }
}

}  // namespace runnel
