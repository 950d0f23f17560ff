#include <cstdint>
#include <memory>
#include <optional>

#include <dlfcn.h>

#include "core/plugin/plugin_entry.h"
#include "core/xml/xml_reading.h"
#include "plugins/application/extension_registry.h"
#include "plugins/real_time_check/application_check.h"

namespace runnel {

namespace {

// So many cycles a module needs until its pools have the size that they keep.
constexpr std::uint64_t kFirstCycles = 20;
constexpr double kMostFirstCycles = 1e9;

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
  const auto find = reinterpret_cast<const RealTimeHooks* (*)() noexcept>(
      dlsym(RTLD_DEFAULT, "RunnelRealTimeHooks"));
  if (find == nullptr) {
    return Error{.message = "what allocates and locks cannot be seen in this process",
                 .hint =
                     "start the program with LD_PRELOAD=librunnel_real_time_hooks.so, as "
                     "'runnel run --check-real-time' does"};
  }
  if (!find()->works) {
    return Error{.message = "what allocates and locks cannot be seen under a sanitizer",
                 .hint = "use a build without"};
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
