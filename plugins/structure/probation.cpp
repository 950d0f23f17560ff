#include "plugins/structure/probation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/base/retry.h"
#include "core/plugin/module_type_name.h"
#include "plugins/structure/replacement.h"

namespace runnel::internal {

void Probation::Add(std::vector<Replaced>& replaced) {
  std::vector<std::uint64_t> until(replaced.size(), 0);
  for (std::size_t i = 0; i < replaced.size(); ++i) {
    const auto progress = scheduler_.ProgressOf(replaced[i].path);
    if (progress && replaced[i].probation_cycles > 0) {
      until[i] = progress->cycles + replaced[i].probation_cycles;
    }
  }
  waiting_.reserve(waiting_.size() + replaced.size());
  for (std::size_t i = 0; i < replaced.size(); ++i) {
    if (until[i] > 0) waiting_.push_back({std::move(replaced[i]), until[i]});
  }
  std::erase_if(replaced, [](const Replaced& each) { return !each.before; });
}

FrameworkElement* Probation::Successor(const Waiting& waiting) {
  const std::lock_guard lock(runtime_.structure_mutex());
  const auto found = runtime_.root().Find(waiting.replaced.path);
  const bool is_it = found && (*found)->id() == waiting.replaced.id;
  return is_it ? *found : nullptr;
}

// Who has thrown waits for the answer, however long that takes.
bool Probation::HasProved(const Waiting& waiting) {
  if (Successor(waiting) == nullptr) return true;
  const auto progress = scheduler_.ProgressOf(waiting.replaced.path);
  return !progress || (!progress->is_stopped && progress->cycles > waiting.until_cycle);
}

// Memory comes before anything is taken out: what is lost on the way would be destroyed while others look at it.
std::vector<UnlistedElement> Probation::Take(bool all) {
  proved_.reserve(proved_.size() + waiting_.size());
  for (Waiting& each : waiting_) {
    if (all || HasProved(each)) proved_.push_back(std::move(each.replaced.before));
  }
  std::erase_if(waiting_, [](const Waiting& each) { return !each.replaced.before; });
  return std::exchange(proved_, {});
}

std::optional<std::string> Probation::Answer(const Fault& fault) {
  const auto found = std::ranges::find_if(
      waiting_, [&](const Waiting& each) { return each.replaced.path == fault.path; });
  if (found == waiting_.end() || Successor(*found) == nullptr) return {};
  if (fault.cycle > found->until_cycle) {
    proved_.reserve(proved_.size() + 1);
    proved_.push_back(std::move(found->replaced.before));
    waiting_.erase(found);
    return {};
  }
  const std::string before = FindModuleType(*found->replaced.before);
  std::string done =
      "the module before (" + (before.empty() ? "made by code" : before) + ") is back in its place";
  auto gone = PutBack(*found);
  if (!gone) {
    throw std::runtime_error("the module before could not be put back: " + gone.error().ToString());
  }
  waiting_.erase(found);
  runtime_.Destroy(std::move(*gone));
  return done;
}

// Leaves `waiting` as it is if it fails.
Result<UnlistedElement> Probation::PutBack(Waiting& waiting) {
  const std::string& path = waiting.replaced.path;
  auto hold = scheduler_.HoldCycles({path}, timeout_);
  if (!hold) return hold.error();
  const ChangeScope all_at_once(runtime_);
  FrameworkElement* const after = Successor(waiting);
  if (after == nullptr) return std::move(waiting.replaced.before);
  const FrameworkElement* const place = NextSibling(*after);
  // Connections may have changed meanwhile: what the old module has no port for goes with the new one.
  const PortMatch match =
      MatchPorts(*after, *waiting.replaced.before, [](const Port&) { return false; });
  waiting.replaced.before->InheritAnnotations(*after);
  auto gone = runtime_.Unlist(*after);
  if (!gone) return gone.error();
  std::size_t moved = 0;
  try {
    for (const auto& [from, to] : match.ports) {
      to->TakeOver(*from);
      ++moved;
    }
    Must(runtime_.List(std::move(waiting.replaced.before), place));
    return gone;
  } catch (...) {
    Retry([&] {
      for (; moved > 0; --moved) {
        const auto& [from, to] = match.ports[moved - 1];
        from->TakeOver(*to);
      }
      (void)runtime_.List(std::move(*gone), place);
    });
    throw;
  }
}

}  // namespace runnel::internal
