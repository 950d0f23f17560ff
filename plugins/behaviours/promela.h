#pragma once

#include <string>
#include <vector>

#include "plugins/behaviours/network.h"

namespace runnel {

/// What a network must keep to.
struct NetworkProperty {
  enum class Kind {
    kNever,       ///< never are all of `active` active and none of `others`
    kEventually,  ///< all of `active` are active some time, each time after all of `others` were; without others: once
  };
  Kind kind = Kind::kNever;
  std::vector<std::size_t> active;
  std::vector<std::size_t> others = {};
};

/// The network in the language of Spin: in each cycle, each behaviour that may decides whether it wants to be active, in any way
/// (for kEventually: who wants to, wants until it has been, and nobody does or rests for more than three cycles), and all are
/// worked out in their order. A run
/// prints "runnel 0101…" for each cycle. `property`: nullptr for none.
[[nodiscard]] std::string PromelaText(const BehaviourNetwork& network, const NetworkProperty* property);

}  // namespace runnel
