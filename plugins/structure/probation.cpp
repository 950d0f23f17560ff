#include "plugins/structure/probation.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "core/base/retry.h"
#include "core/plugin/module_type_name.h"
#include "core/port/driving_ports.h"
#include "plugins/structure/module_values.h"
#include "plugins/structure/replacement.h"

namespace runnel::internal {

void Probation::Add(std::vector<Replaced>& replaced, Diagnostics& diagnostics) {
  std::vector<std::uint64_t> until(replaced.size(), 0);
  for (std::size_t i = 0; i < replaced.size(); ++i) {
    const auto progress = scheduler_.ProgressOf(replaced[i].path);
    if (progress && replaced[i].probation_cycles > 0) until[i] = progress->cycles + replaced[i].probation_cycles;
    const auto is_it = [id = replaced[i].before->id()](const Waiting& each) { return each.replaced.id == id; };
    if (until[i] > 0 || std::ranges::none_of(waiting_, is_it)) continue;
    diagnostics.AddWarning(
        {.message = "its probation ends by this: the module before does not come back", .path = replaced[i].path});
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
  if (waiting.until_cycle == 0 || Successor(waiting) == nullptr) return true;
  const auto progress = scheduler_.ProgressOf(waiting.replaced.path);
  return !progress || (!progress->has_failed && progress->cycles > waiting.until_cycle);
}

// Memory comes before anything is taken out: what is lost on the way would be destroyed while others look at it.
std::vector<UnlistedElement> Probation::Take(bool all) {
  proved_.reserve(proved_.size() + waiting_.size());
  for (Waiting& each : waiting_) {
    if (all || HasProved(each)) each.until_cycle = 0;
  }
  for (Waiting& each : waiting_) {
    if (each.until_cycle == 0) proved_.push_back(std::move(each.replaced.before));
  }
  std::erase_if(waiting_, [](const Waiting& each) { return !each.replaced.before; });
  return std::exchange(proved_, {});
}

std::vector<Probation::Waiting>::iterator Probation::Find(const std::string& path) {
  return std::ranges::find_if(
      waiting_, [&](const Waiting& each) { return each.replaced.path == path && Successor(each) != nullptr; });
}

bool Probation::Concerns(const Fault& fault) {
  const auto found = Find(fault.path);
  if (found == waiting_.end()) return false;
  if (fault.cycle > found->until_cycle) found->until_cycle = 0;
  return found->until_cycle > 0;
}

std::string Probation::PutBack(const Fault& fault, OrderedMutex& mutex) {
  auto hold = scheduler_.HoldCycles({fault.path}, timeout_);
  std::unique_lock lock(mutex);
  const auto found = Find(fault.path);
  const auto progress = scheduler_.ProgressOf(fault.path);
  const bool is_there = found != waiting_.end() && progress && progress->has_failed;
  if (!is_there) return "others have removed it meanwhile";
  const std::string before = FindModuleType(*found->replaced.before);
  std::string done = "the module before (" + (before.empty() ? "made by code" : before) + ") is back in its place";
  auto gone = hold ? PutBack(*found, done) : hold.error();
  if (!gone) throw std::runtime_error("the module before could not be put back: " + gone.error().ToString());
  waiting_.erase(found);
  lock.unlock();
  hold->Release();
  runtime_.Destroy(std::move(*gone));
  return done;
}

// Between two cycles. Leaves `waiting` as it is if it fails. `done` gets what is lost.
Result<UnlistedElement> Probation::PutBack(Waiting& waiting, std::string& done) {
  const ChangeScope all_at_once(runtime_);
  FrameworkElement* const after = Successor(waiting);
  if (after == nullptr) return std::move(waiting.replaced.before);
  const FrameworkElement* const place = NextSibling(*after);
  std::vector<BeforeHandOver::Held> held;  // by one that has failed and goes anyway, too
  for (auto* each : {after, &*waiting.replaced.before}) (void)Settle(*each, held);
  FrameworkElement& before = *waiting.replaced.before;
  before.VisitAll<Port>([](Port& port) { DrivingState::Of(port).is_later = true; });
  // Connections may have changed meanwhile: what the old module has no port for goes with the new one.
  StructureOverlay overlay(runtime_);
  const PortMatch match = MatchPorts(*after, before, overlay);
  if (match.errors.size() > match.misfits.size()) return match.errors.front();  // it would move, or is held
  if (auto possible = overlay.Replace(*after, before, match.ports); !possible) return possible.error();
  InheritAnnotations(before, *after, match.ports);
  for (const Error& each : CopyValues(*after, waiting.replaced.began, nullptr, before)) {
    done += "; not taken over: " + each.ToString();
  }
  auto gone = runtime_.Unlist(*after);
  if (!gone) return gone.error();
  std::size_t moved = 0;
  try {
    for (const auto& [from, to] : match.ports) {
      TakeOver(*to, *from, *after, before);
      ++moved;
    }
    Must(runtime_.List(std::move(waiting.replaced.before), place));
  } catch (...) {
    Retry([&] {
      for (; moved > 0; --moved) {
        const auto& [from, to] = match.ports[moved - 1];
        TakeOver(*from, *to, before, *after);
      }
      (void)runtime_.List(std::move(*gone), place);
    });
    throw;
  }
  for (std::size_t i = 0; i < match.misfits.size(); ++i) {
    Result<void> taken = Error{};
    Retry([&] { taken = TakeOverFeed(*match.misfits[i].first, *after, before); });
    const Error& each = match.errors[i];
    if (!taken) Retry([&] { done += "; not taken over: " + each.path + ": " + each.message; });
  }
  return gone;
}

}  // namespace runnel::internal
