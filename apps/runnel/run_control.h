#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "plugins/application/application.h"
#include "plugins/application/application_extension.h"

namespace runnel::program {

/// What clients of a running application ask of the program that runs it: that it ends, or runs again.
///
/// Threads: any.
class RunControl final : public ApplicationExtension {
 public:
  /// Whether the application could be built again from its file. Errors: why not.
  using Check = std::function<Result<void>()>;
  explicit RunControl(Check check) : check_(std::move(check)) {}

  void AddHooks(Application& application, ServiceHooks& hooks) override;

  /// Somebody has asked for the end of the run, or for another one.
  [[nodiscard]] bool is_asked() const noexcept { return is_asked_.load(); }
  [[nodiscard]] bool shall_restart() const noexcept { return shall_restart_.load(); }

 private:
  const Check check_;
  std::atomic<bool> is_asked_{false};
  std::atomic<bool> shall_restart_{false};
};

}  // namespace runnel::program
