#pragma once

#include <memory>
#include <string>

#include "plugins/application/application_extension.h"
#include "plugins/real_time_check/real_time_watch.h"

namespace runnel {

/// Watches the cycles of an application for what takes time that nobody can foresee, and says at the end which
/// modules did it, and where; the run has failed then.
class ApplicationCheck final : public ApplicationExtension {
 public:
  ApplicationCheck(const RealTimeHooks& hooks, std::uint64_t first_cycles)
      : watch_(std::make_unique<RealTimeWatch>(hooks, first_cycles)) {}

  Result<void> Prepare(FrameworkElement& application, SchedulerOptions& options) override;
  std::string Finish(Diagnostics& problems) override;
  void Release() noexcept override { watch_.reset(); }

 private:
  std::unique_ptr<RealTimeWatch> watch_;
};

}  // namespace runnel
