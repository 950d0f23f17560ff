#pragma once

#include <deque>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/module/group.h"
#include "core/module/group_parameter.h"
#include "core/port/proxy_port.h"
#include "plugins/behaviours/behaviour.h"

namespace runnel {

/// Which behaviour within a group speaks for it: the group is a behaviour to others then. For viewers and checks; kept
/// with the group.
struct CharacteristicBehaviour final : Annotation {
  explicit CharacteristicBehaviour(std::string behaviour_name) : name(std::move(behaviour_name)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<CharacteristicBehaviour>(name);
  }

  std::string name;  ///< of a module directly in the group, when it was said
};

/// The behaviour that speaks for the group; nullptr if none is said to, or is there.
[[nodiscard]] Behaviour* CharacteristicOf(const FrameworkElement& group);

/// What is missing for `characteristic` to speak for the group it is in: interface ports called as its own (stimulation,
/// inhibition1 …, activity, target_rating) that lead to its own. Under the structure lock.
[[nodiscard]] Result<void> CheckBehaviourGroup(const FrameworkElement& group, const std::string& characteristic);

/// A group written in C++ that is a behaviour to others: one of those within, the characteristic one, has its signals,
/// its mode and its number of inhibitions.
///
///     class Careful final : public BehaviourGroup {
///       using BehaviourGroup::BehaviourGroup;
///       FusionBehaviour motion{{*this, "motion"}};
///       Result<void> Construct() override { …; return Characterise(motion); }
///     };
class BehaviourGroup : public Group {
 public:
  using Group::Group;

 protected:
  /// Makes the interface ports and the parameter, and connects them. Once. Errors: another one speaks for it already;
  /// it is not directly within; as Port::Connect().
  Result<void> Characterise(Behaviour& characteristic);

 private:
  std::deque<ProxyPort> ports_;
  std::unique_ptr<GroupParameter> mode_;
};

}  // namespace runnel
