#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel {

class Port;

/// A rule that connections have to keep: which ports may be connected is more than a matter of types.
struct ConnectionRule {
  std::string name;  ///< "safety/commands": for those who want to know who says so
  std::string summary = {};
  /// Nothing, or a sentence why `from` must not feed `to`. Called under the structure lock, for each connection
  /// that is asked for, before anything has changed; must not change the structure itself.
  std::function<Result<void>(const Port& from, const Port& to)> check;
};

/// For plugins, when they are loaded, and for programs: from then on all connections that are made in this
/// process have to keep the rule. One of the same name takes the place of the one before; without a check, the
/// rule is taken back. What is connected already stays. Locks.
void AddConnectionRule(ConnectionRule rule);

/// In the order of names. Locks.
[[nodiscard]] std::vector<ConnectionRule> ConnectionRules();

/// What the first rule that does not allow it says. What a rule throws is such a sentence, too.
[[nodiscard]] Result<void> CheckConnectionRules(const Port& from, const Port& to);

}  // namespace runnel
