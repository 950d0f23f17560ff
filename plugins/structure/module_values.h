#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/element/configurable.h"
#include "core/element/framework_element.h"
#include "core/paths/path_search.h"
#include "plugins/structure/change.h"

namespace runnel::internal {

/// The values that a module of the same type would not have by itself.
[[nodiscard]] std::vector<Setting> SettingsOf(const FrameworkElement& module);

/// A parameter of a module, or of a part of one, as it is when the module goes.
struct ParameterRecord {
  std::string path;  ///< in the module: "parameter/gain", "motor/parameter/gain"
  std::string name;
  std::string former_name;  ///< "": none
  bool is_of_part = false;  ///< it is none of the module itself
  bool is_group = false;
  std::vector<std::string> targets;  ///< of a group, paths of what it stands for in the end
  Configurable::Values values;
  bool is_named = false;                 ///< it has been set by the change that is taken back
  std::optional<std::string> left = {};  ///< what that has left as set at the module in its place (NoteLeft())
  /// Where this comes back: that of the module in its place, in which only what has been given since counts, and whether
  /// what has been set there does, since it has been set since.
  std::optional<Configurable::Values> present = {};
  bool is_set_since = false;

  [[nodiscard]] const Configurable::Values& set() const noexcept { return is_set_since ? *present : values; }
};
using ParameterRecords = std::vector<ParameterRecord>;

/// What a module in the place of `before` begins with. `again`: what comes back by that; nullptr: another one. Under the
/// structure lock.
[[nodiscard]] ParameterRecords RecordsOf(const FrameworkElement& before, const GivenParameters& again = nullptr);
/// What `parameter`, at or below `before`, is in `after`: of its name, or of a former one of either; of a part, of its path.
[[nodiscard]] ConfigurableElement ParameterLike(const FrameworkElement& parameter, const FrameworkElement& before,
                                                const FrameworkElement& after);
/// What is to come back where `change`, which has put `after` in the place of `before`, is taken back.
[[nodiscard]] GivenParameters RecordsToComeBack(const FrameworkElement& before, const FrameworkElement& after,
                                                const ReplaceModule& change);

/// Right after that change has given `after` its values.
void NoteLeft(const GivenParameters& records, const FrameworkElement& after);

/// Sets the parameters of a module that has just been made: as the records have been, as far as it has parameters like these,
/// then to `settings`; and has it make the ports that follow from them. What stands for parameters within (GroupParameter)
/// is set when these are there.
Result<void> ConfigureNew(FrameworkElement& made, const ParameterRecords& records,
                          const std::vector<Setting>& settings);

/// Gives `after`, which is prepared, the values of `before`: what outputs have given, and what has been set, of parts only
/// what has been since they were as in `began`; but for what `change` sets, and what cannot be set any more. Of a part that
/// `after` has not, by the parameter of the composite that stands for it. `change`: that has it made; nullptr: it comes back,
/// and of the module itself, too, only what has been set since goes over. Neither runs. What is refused.
[[nodiscard]] std::vector<Error> CopyValues(const FrameworkElement& before, const ParameterRecords& began,
                                            const ReplaceModule* change, const FrameworkElement& after);

}  // namespace runnel::internal
