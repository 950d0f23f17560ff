#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/module/hand_over.h"
#include "core/port/port.h"
#include "plugins/structure/change.h"
#include "plugins/structure/structure_overlay.h"

namespace runnel::internal {

/// The values that a module of the same type would not have by itself.
[[nodiscard]] std::vector<Setting> SettingsOf(const FrameworkElement& module);

/// Sets the parameters of a module that has just been made: to `inherited`, as far as it has parameters of these names,
/// then to `settings`; and has it make the ports that
/// follow from them. What stands for parameters within (GroupParameter) is set when these are there.
Result<void> ConfigureNew(FrameworkElement& made, const std::vector<Setting>& inherited,
                          const std::vector<Setting>& settings);

/// The values of a module's parameters as they are now, for CopyLateSettings().
using Values = std::map<std::string, std::string>;
[[nodiscard]] Values ValuesOf(const FrameworkElement& module);

/// Gives `after`, which is prepared, the values that parameters of the same name have got in `before`
/// since it had `values`, but for those that `settings` name and those that cannot be set any more.
/// Errors: a value that is refused.
Result<void> CopyLateSettings(const FrameworkElement& before, const Values& values,
                              const std::vector<Setting>& settings, FrameworkElement& after);

/// The ports of a module, each with that which takes over from it.
struct PortMatch {
  std::vector<std::pair<Port*, Port*>> ports;
  std::vector<Error> errors;  ///< what is connected, marked or blocked, and has no counterpart, with the nearest name
  /// Those of them that can be cut, each with what has its name in the other module, or nullptr.
  std::vector<std::pair<Port*, Port*>> misfits;
};
/// `overlay`: what is connected by then.
[[nodiscard]] PortMatch MatchPorts(FrameworkElement& before, FrameworkElement& after, const StructureOverlay& overlay);

/// Errors: one of them is a composite, and not the same moves in both, by ports of the same names. What stops and holds that is kept
/// with each port, so it would have no place in the other one, or another meaning.
[[nodiscard]] Result<void> CheckMovesAlike(FrameworkElement& before, FrameworkElement& after,
                                           const std::vector<std::pair<Port*, Port*>>& ports);

/// Also of ports that are not at the same place in a module as in a composite. What only a module's input can have stays.
void InheritAnnotations(FrameworkElement& after, const FrameworkElement& before,
                        const std::vector<std::pair<Port*, Port*>>& ports);
/// As a module's port does, or a composite's.
void TakeOver(Port& port, Port& from, const FrameworkElement& before, const FrameworkElement& after);

/// Which kept states of `before` cannot be handed over to `after`, and why.
[[nodiscard]] std::vector<Error> StateRefusals(const FrameworkElement& before, const FrameworkElement& after);

/// What goes on of the module beside cycles ends, or waits until what `held` gets is let go of. Errors: what it throws.
Result<void> Settle(const FrameworkElement& module, std::vector<BeforeHandOver::Held>& held);

/// Hands over the kept states that can be. Neither module runs. Errors: what copying throws.
Result<void> CopyState(const FrameworkElement& before, FrameworkElement& after);

/// Whether one of the settings is of the module's parameter, also by a former name.
[[nodiscard]] bool Names(const std::vector<Setting>& settings, const FrameworkElement& module,
                         const std::string& parameter);

/// Hands over what outputs have set of parameters, by the ports through which they do, but for what a person sets by the
/// change: what is taken back (`change.state`) sets nothing of that. Before the ports take over. Errors: what copying throws.
[[nodiscard]] Result<void> CopyFed(const std::vector<std::pair<Port*, Port*>>& ports, const ReplaceModule& change);
/// The same and taking over, of one port whose counterpart could not be made as long as `after` was beside the tree.
[[nodiscard]] Result<void> TakeOverFed(Port& port, const FrameworkElement& before, FrameworkElement& after);

}  // namespace runnel::internal
