#include "plugins/parameters/parameter_base.h"

#include <mutex>

#include "core/base/characters.h"
#include "core/element/runtime.h"
#include "core/module/port_group.h"
#include "plugins/parameters/units.h"

namespace runnel {

namespace {

constexpr const char* kGroupName = "parameter";

// Owned by the module like any element made at run time; the parameters in it belong to the
// module's C++ object and are gone before the module deletes what it owns.
FrameworkElement& ParameterGroup(FrameworkElement& module) {
  if (FrameworkElement* group = module.FindChild(kGroupName)) return *group;
  return module.runtime().Create<PortGroup>(module, kGroupName);
}

}  // namespace

Result<std::string> internal::ReadableText(std::string_view text, bool is_number,
                                           const std::string& unit) {
  if (const std::string fault = UnwritableCharacter(text); !fault.empty()) {
    return Error{.message = "the value contains " + fault};
  }
  if (is_number) return NumberInUnit(text, unit);
  return std::string(text);
}

ParameterBase::ParameterBase(FrameworkElement* module, std::string name, ConfigurableInfo info)
    : FrameworkElement({ParameterGroup(*module), std::move(name)}, ElementKind::kParameter),
      info_(std::move(info)) {}

Result<void> ParameterBase::SetFromText(std::string_view text) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (info_.is_static && life_cycle() == LifeCycle::kReady) {
    return Error{
        .message = "the parameter is static: it can be set only before its module is ready",
        .path = path(),
        .hint = "set it in the application file"};
  }
  if (auto acceptable = CheckText(text); !acceptable) {
    Error error = acceptable.error();
    error.path = path();
    return error;
  }
  Assign(text);
  return {};
}

}  // namespace runnel
