#pragma once

#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/module/kept_state.h"
#include "core/port/port.h"
#include "plugins/structure/change.h"
#include "plugins/structure/structure_overlay.h"

namespace runnel::internal {

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

/// Has the input by which an output sets a parameter take over, which could not be made while `after` was beside the tree.
[[nodiscard]] Result<void> TakeOverFeed(Port& port, const FrameworkElement& before, FrameworkElement& after);

}  // namespace runnel::internal
