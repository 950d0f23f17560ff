// A plugin for tests: planners that fail on their way, each in its own manner.

#include <cstdlib>
#include <stdexcept>

#include "core/plugin/plugin_entry.h"
#include "modules/planning/bug_planner.h"

namespace {

using namespace runnel;

constexpr double kHealthy = 0.5;  // m of the way, before it fails

enum class Failure { kCrash, kHang, kThrow };

template <Failure failure>
class BrokenBug final : public BugPlanner {
 public:
  using BugPlanner::BugPlanner;

 private:
  BugComponents Components() const override {
    if (state().status.path_length > kHealthy) Fail();
    return Assemble({});
  }

  static void Fail() {
    if (failure == Failure::kCrash) std::abort();
    if (failure == Failure::kThrow) throw std::runtime_error("out of order");
    for (volatile bool forever = true; forever;) {
    }
  }
};

}  // namespace

RUNNEL_PLUGIN(broken_bug, registry) {
  registry.Add<BrokenBug<Failure::kCrash>>("broken/crash", "ends its process");
  registry.Add<BrokenBug<Failure::kHang>>("broken/hang", "never comes back");
  registry.Add<BrokenBug<Failure::kThrow>>("broken/throw", "throws");
}
