#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace runnel::test {

/// What a random search for a way around STOP has done, and found.
struct StopSearchResult {
  std::uint64_t steps = 0;
  std::uint64_t presses = 0;
  std::uint64_t reloads = 0;
  std::uint64_t refused = 0;          ///< changes that the editor refused: of what was not there any more
  std::uint64_t checks = 0;           ///< driving ports looked at
  std::uint64_t checks_in_force = 0;  ///< of those, while STOP was in force
  std::uint64_t moving = 0;     ///< of those, that had another value than the safe one, as they may when it is not
  std::uint64_t came_back = 0;  ///< marks and blocks of what was away and has come back by undo or redo
  std::vector<std::string> violations;  ///< with the step and what was done last
};

/// Runs xml/apps/bug_demo.xml on simulated time and does something at random in each step: press, release, block,
/// set by hand, by a rule, rename, delete, undo, redo, swap, make anew, copy, cut and mend connections, reload a plugin, run the
/// application again from its file, run cycles.
/// After each of them no driving port may have another value than its safe one while STOP is in force, and after
/// that none that was measured or published before the release. What was marked as driving or blocked stays so as
/// long as it is there, and is so again when an undo or a redo brings it back. It begins with each of these once; the same seed
/// does the same.
[[nodiscard]] StopSearchResult SearchForWaysAroundStop(std::uint64_t seed, std::uint64_t steps);

}  // namespace runnel::test
