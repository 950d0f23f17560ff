#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plugins/behaviours/behaviour.h"

namespace runnel {

/// One behaviour of a network, with those that it depends on by their places in the list of all.
struct NetworkNode {
  const Behaviour* behaviour = nullptr;
  std::string name;  ///< its path, seen from the application
  StimulationMode mode = StimulationMode::kAuto;
  bool has_foreign_stimulation = false;  ///< by what is no behaviour, so at any time
  std::vector<std::size_t> stimulators = {};
  std::vector<std::size_t> inhibitors = {};
  std::vector<std::size_t> needs_all = {};  ///< it is active only while all of these are
  std::vector<std::size_t> needs_any = {};  ///< … it is active if and only if any of these is; none: as it likes
  std::vector<std::size_t> late = {};       ///< of all of these, those whose connection says that it is late
  std::vector<std::size_t> elsewhere = {};  ///< of all of these, those that another thread runs
};

/// Something that is no behaviour, to whose one input several behaviours say what they want, without a fusion.
struct SharedActuator {
  std::string path;  ///< of the input
  std::vector<std::size_t> behaviours;
};

/// The behaviours of an application and what connects them, through groups, composites and conversions: what is thought
/// about, without what they compute. An activity counts as all or nothing, and derived ones as the activity.
struct BehaviourNetwork {
  std::vector<NetworkNode>
      nodes;  ///< in the order in which they may run: after those that they depend on, if there is one
  std::vector<SharedActuator> shared;
};

/// Under the structure lock.
[[nodiscard]] BehaviourNetwork ReadNetwork(FrameworkElement& application);

/// What is wrong with a network, as sentences about paths: see checks below.
struct NetworkFlaw {
  std::string path;  ///< of the element concerned
  std::string message;
  std::string hint = {};
};

/// Behaviours that can never be active: nobody stimulates them, or only some who never are, or whoever stimulates them
/// has them inhibited at the same time.
[[nodiscard]] std::vector<NetworkFlaw> FindUnreachable(const BehaviourNetwork& network);
/// Loops with an odd number of inhibitions: who is active in them has itself inhibited some cycles later. And such with an
/// even number of which two connections or more can be a cycle late: as none knows yet of the others, they go on and off
/// together. (With one that is late, who runs first holds the others down.) From another thread each is; within a thread
/// those that say so, but one at least is not, as somebody runs behind another one.
[[nodiscard]] std::vector<NetworkFlaw> FindOscillations(const BehaviourNetwork& network);
/// Two behaviours that can be active at once and command one actuator without a fusion.
[[nodiscard]] std::vector<NetworkFlaw> FindConflicts(const BehaviourNetwork& network);

}  // namespace runnel
