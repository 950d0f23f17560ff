#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/paths/path_search.h"
#include "plugins/structure/change.h"

namespace runnel::internal {

/// The values that a module of the same type would not have by itself.
[[nodiscard]] std::vector<Setting> SettingsOf(const FrameworkElement& module);
/// What another module begins with, if it has a parameter of the name: what has been set, the value that it has, and the unit.
struct InheritedValue {
  std::string parameter, own, value, default_value, unit;
};
using Inherited = std::vector<InheritedValue>;
[[nodiscard]] Inherited InheritedFrom(const FrameworkElement& module);

/// Sets the parameters of a module that has just been made: to `inherited`, as far as it has parameters of these names,
/// then to `settings`; and has it make the ports that
/// follow from them. What stands for parameters within (GroupParameter) is set when these are there.
Result<void> ConfigureNew(FrameworkElement& made, const Inherited& inherited, const std::vector<Setting>& settings);

/// The parameter of `after` that is what `parameter` is at or below `before`: of its name, or of a former one of either.
[[nodiscard]] ConfigurableElement ParameterLike(const FrameworkElement& parameter, const FrameworkElement& before,
                                                const FrameworkElement& after);
/// Whether the same has been set at both.
[[nodiscard]] bool IsAlike(const Configurable& from, const Configurable& to);
/// The parameters of the module and its parts that settings set.
[[nodiscard]] std::set<const Configurable*> NamedBy(const std::vector<Setting>& settings,
                                                    const FrameworkElement& module);

/// A number of Configurable::Own of the parameters of a module and its parts, by their paths in it.
using SettingCounts = std::map<std::string, std::uint64_t>;
[[nodiscard]] SettingCounts NumbersOf(const FrameworkElement& module, std::uint64_t Configurable::Own::*number);

/// Gives `after`, which is prepared, what parameters of `before` have been set to since `counts`, but for what `change` sets and what
/// cannot be set any more, and all that outputs have given. Of a part that `after` has not, by the parameter of the composite
/// that stands for it. `change`: that has it made; nullptr: it comes back, with what had been set there. Neither runs. What is
/// refused of what has been set.
[[nodiscard]] std::vector<Error> CopyValues(FrameworkElement& before, const SettingCounts& counts,
                                            const ReplaceModule* change, const FrameworkElement& after);

}  // namespace runnel::internal
