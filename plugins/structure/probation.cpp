#include "plugins/structure/probation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/plugin/module_type_name.h"
#include "plugins/structure/replacement.h"

namespace runnel::internal {

std::vector<UnlistedElement> Probation::Add(std::vector<Replaced> replaced) {
  std::vector<UnlistedElement> not_kept;
  for (Replaced& each : replaced) {
    const auto progress = scheduler_.ProgressOf(each.path);
    if (each.probation_cycles == 0 || !progress) {
      not_kept.push_back(std::move(each.before));
      continue;
    }
    Waiting waiting;
    waiting.until_cycle = progress->cycles + each.probation_cycles;
    waiting.replaced = std::move(each);
    waiting_.push_back(std::move(waiting));
  }
  return not_kept;
}

FrameworkElement* Probation::Successor(const Waiting& waiting) {
  const std::lock_guard lock(runtime_.structure_mutex());
  const auto found = runtime_.root().Find(waiting.replaced.path);
  const bool is_it = found && (*found)->serial() == waiting.replaced.serial;
  return is_it ? *found : nullptr;
}

// Who has thrown waits for the answer, however long that takes.
bool Probation::HasProved(const Waiting& waiting) {
  if (Successor(waiting) == nullptr) return true;
  const auto progress = scheduler_.ProgressOf(waiting.replaced.path);
  return !progress || (!progress->is_stopped && progress->cycles > waiting.until_cycle);
}

std::vector<UnlistedElement> Probation::TakeProved() {
  std::vector<UnlistedElement> proved = std::exchange(proved_, {});
  for (Waiting& each : waiting_) {
    if (HasProved(each)) proved.push_back(std::move(each.replaced.before));
  }
  std::erase_if(waiting_, [](const Waiting& each) { return !each.replaced.before; });
  return proved;
}

std::vector<UnlistedElement> Probation::TakeAll() {
  std::vector<UnlistedElement> all = std::exchange(proved_, {});
  for (Waiting& each : waiting_) all.push_back(std::move(each.replaced.before));
  waiting_.clear();
  return all;
}

std::optional<std::string> Probation::Answer(const Fault& fault) {
  const auto found = std::ranges::find_if(
      waiting_, [&](const Waiting& each) { return each.replaced.path == fault.path; });
  if (found == waiting_.end() || Successor(*found) == nullptr) return {};
  Waiting waiting = std::move(*found);
  waiting_.erase(found);
  if (fault.cycle > waiting.until_cycle) {
    proved_.push_back(std::move(waiting.replaced.before));
    return {};
  }
  const std::string before = FindModuleType(*waiting.replaced.before);
  auto gone = PutBack(std::move(waiting));
  if (!gone) {
    throw std::runtime_error("the module before could not be put back: " + gone.error().ToString());
  }
  runtime_.Destroy(std::move(*gone));
  return "the module before (" + (before.empty() ? "made by code" : before) +
         ") is back in its place";
}

Result<UnlistedElement> Probation::PutBack(Waiting waiting) {
  const std::string& path = waiting.replaced.path;
  auto hold = scheduler_.HoldCycles({path}, patience_);
  if (!hold) {
    waiting_.push_back(std::move(waiting));
    return hold.error();
  }
  const ChangeScope all_at_once(runtime_);
  FrameworkElement* const after = Successor(waiting);
  if (after == nullptr) return std::move(waiting.replaced.before);
  const auto& siblings = after->parent()->children();
  const auto next = std::next(std::ranges::find(siblings, after));
  const FrameworkElement* const place = next == siblings.end() ? nullptr : *next;
  FrameworkElement& before = *waiting.replaced.before;
  // Connections may have changed meanwhile: what the old module has no port for goes with the new one.
  const PortMatch match = MatchPorts(*after, before, [](const Port&) { return false; });
  auto gone = runtime_.Unlist(*after);
  if (!gone) {
    waiting_.push_back(std::move(waiting));
    return gone.error();
  }
  for (const auto& [from, to] : match.ports) to->TakeOver(*from);
  (void)runtime_.List(std::move(waiting.replaced.before), place);
  return gone;
}

}  // namespace runnel::internal
