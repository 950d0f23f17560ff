#include <cstdint>
#include <memory>

#include <dlfcn.h>

#include "core/plugin/plugin_entry.h"
#include "core/xml/xml_reading.h"
#include "plugins/application/application_extension.h"
#include "plugins/real_time_check/real_time_watch.h"

namespace runnel {

namespace {

// So many cycles a module needs until its pools have the size that they keep.
constexpr std::uint64_t kFirstCycles = 20;
constexpr double kMostFirstCycles = 1e9;

/// Watches the cycles of an application for what takes time that nobody can foresee, and says at the end which
/// modules did it, and where; the run has failed then.
class ApplicationCheck final : public ApplicationExtension {
 public:
  ApplicationCheck(const RealTimeHooks& hooks, std::uint64_t first_cycles)
      : watch_(std::make_unique<RealTimeWatch>(hooks, first_cycles)) {}

  Result<void> Prepare(FrameworkElement& /*application*/, SchedulerOptions& options) override {
    options.watch = watch_.get();
    return {};
  }

  std::string Finish(Diagnostics& problems) override {
    const std::vector<RealTimeBreaches> all = watch_->Breaches();
    for (const RealTimeBreaches& of_module : all) {
      for (const RealTimeBreach& each : of_module.breaches) {
        problems.Add({.message = each.ToString(), .path = of_module.path});
      }
      if (of_module.others == 0) continue;
      problems.Add({.message = "does so at further places, " + std::to_string(of_module.others) + " times",
                    .path = of_module.path});
    }
    return all.empty() ? "no module has allocated, locked or called the system in its cycle\n" : "";
  }

  void Release() noexcept override { watch_.reset(); }

 private:
  std::unique_ptr<RealTimeWatch> watch_;
};

Result<Extensions> MakeCheck(const ExtensionArguments& arguments) {
  const std::string text = arguments.Find("check-real-time");
  std::uint64_t first_cycles = kFirstCycles;
  if (!text.empty()) {
    const auto number = ParseNumber(text);
    if (!number || *number < 0 || *number > kMostFirstCycles) {
      return Error{.message = "--check-real-time: '" + text + "' is not a number of cycles"};
    }
    first_cycles = static_cast<std::uint64_t>(*number);
  }
  const auto find = reinterpret_cast<const RealTimeHooks* (*)() noexcept>(dlsym(RTLD_DEFAULT, "RunnelRealTimeHooks"));
  if (find == nullptr) {
    return Error{.message = "what allocates and locks cannot be seen in this process",
                 .hint =
                     "start the program with LD_PRELOAD=librunnel_real_time_hooks.so, as "
                     "'runnel run --check-real-time' does"};
  }
  if (!find()->works) {
    return Error{.message = "what allocates and locks cannot be seen under a sanitizer", .hint = "use a build without"};
  }
  return Extensions{std::make_shared<ApplicationCheck>(*find(), first_cycles)};
}

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(real_time_check, registry) {
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add(runnel::MakeCheck);
  }
}
