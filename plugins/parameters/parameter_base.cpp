#include "plugins/parameters/parameter_base.h"

#include <mutex>
#include <utility>

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

// What no file can carry could not be saved.
Result<void> CheckCharacters(std::string_view text) {
  const std::string fault = UnwritableCharacter(text);
  if (fault.empty()) return {};
  return Error{.message = "the value contains " + fault};
}

}  // namespace

ParameterBase::ParameterBase(FrameworkElement* module, std::string name,
                             internal::ParameterDescription description, const void* default_value)
    : FrameworkElement({ParameterGroup(*module), std::move(name)}, ElementKind::kParameter),
      description_(std::move(description)) {
  if (!description_.is_within_bounds || description_.is_within_bounds(default_value)) return;
  const std::string unit = info().unit.empty() ? "" : " " + info().unit;
  throw ElementError(
      {.message = "its default, " + info().default_value + unit + ", is out of its bounds",
       .path = path(),
       .hint = "they are " + info().bounds + unit});
}

Result<std::shared_ptr<const void>> ParameterBase::Parse(std::string_view text) const {
  if (auto good = CheckCharacters(text); !good) return good.error();
  const auto readable =
      description_.is_number ? NumberInUnit(text, info().unit) : Result(std::string(text));
  if (!readable) return readable.error();
  const std::shared_ptr<void> value = type().Make();
  if (auto read = runnel::SetFromText(type(), *readable, value.get()); !read) {
    Error error = read.error();
    if (description_.is_number && error.hint.empty() && !info().unit.empty()) {
      error.hint = "write a number; without a unit it is in " + info().unit;
    }
    return error;
  }
  if (auto good = Check(value.get()); !good) return good.error();
  return std::shared_ptr<const void>(value);
}

Result<void> ParameterBase::Check(const void* value) const {
  if (description_.is_within_bounds && !description_.is_within_bounds(value)) {
    const std::string unit = info().unit.empty() ? "" : " " + info().unit;
    return Error{.message = runnel::ToText(type(), value) + unit + " is out of bounds",
                 .hint = "allowed is " + info().bounds + unit};
  }
  // Only a static one can have texts in it.
  if (info().is_static) return CheckCharacters(runnel::ToText(type(), value));
  return {};
}

Result<void> ParameterBase::SetFrom(const void* value) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (info().is_static && life_cycle() == LifeCycle::kReady) {
    return Error{
        .message = "the parameter is static: it can be set only before its module is ready",
        .path = path(),
        .hint = "set it in the application file"};
  }
  if (auto good = Check(value); !good) {
    Error error = good.error();
    error.path = path();
    return error;
  }
  Assign(value);
  return {};
}

}  // namespace runnel
