#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/element/unlisted_element.h"
#include "core/port/port.h"

namespace runnel::internal {

/// What has been set at an element, and at all below it, while the application ran: its annotations (tags, level of the
/// log, given limits, …), and of ports what holds the values that readers find. The one way by which undo, copy and
/// whatever else makes an element again hand that over: who adds something that belongs to an element keeps it as an
/// annotation with ForReplacement(), or with the port (PortExtras), and it goes along everywhere.
///
/// Threads: under the structure lock.
class ElementState {
 public:
  using Inherit = FrameworkElement::Inherit;
  enum class Below { kIncluded, kLeftOut };

  ElementState(const FrameworkElement& element, Inherit how, Below below = Below::kIncluded);

  /// Before `made` is prepared: that may go by what it is annotated with.
  void GiveAnnotations(FrameworkElement& made) const;
  /// The element as it was, with all below it, by their annotations alone.
  [[nodiscard]] const FrameworkElement& noted() const { return *noted_; }
  /// Ports, each with that which takes over from it.
  using TakenOver = std::vector<std::pair<Port*, Port*>>;
  /// When nobody but its readers can see `made` yet. Nothing to ports that take over from others, as they have that.
  /// Errors: as Port::PublishByHand().
  Result<void> GivePorts(FrameworkElement& made, const TakenOver& taken_over = {}) const;
  /// Tells the ports of `made` what stopped those noted, to be so again when they take the places of others.
  void NoteWayBack(FrameworkElement& made) const;

 private:
  Inherit how_;
  // Elements of no kind beside the tree, under the names of those whose annotations they keep.
  UnlistedElement noted_;
};

/// What would get lost with `port`, as nothing stands for it any more: "its value by hand, its limits"; "" for nothing.
[[nodiscard]] std::string WhatIsSetAt(const Port& port);
/// Whether a recorder takes its values.
[[nodiscard]] bool IsRecorded(const Port& port);
/// Whether an extension offers it to others, by its name.
[[nodiscard]] bool IsOffered(const Port& port);

}  // namespace runnel::internal
