#include "plugins/genom_execution/exclusion.h"

#include "core/lockfree/asymmetric_fence.h"

namespace runnel::genom_execution {

ConflictMatrix::ConflictMatrix(const ComponentTable& component)
    : words_((component.units() + 63) / 64), bits_(component.units() * words_), has_any_(component.units()), has_async_(component.units()) {
  for (const auto& [a, b] : component.conflicts) {
    bits_[a * words_ + b / 64] |= std::uint64_t{1} << (b % 64);
    bits_[b * words_ + a / 64] |= std::uint64_t{1} << (a % 64);
    has_any_[a] = has_any_[b] = true;
    if (a < component.codels.size() && component.codels[a].is_async) has_async_[b] = true;
    if (b < component.codels.size() && component.codels[b].is_async) has_async_[a] = true;
  }
}

void Exclusion::Want(std::size_t place, std::size_t unit) noexcept {
  board_.Want(place, unit);
  WakeOthers(place, unit);  // who looked while there was no ticket
}

bool Exclusion::May(std::size_t place) const noexcept {
  return board_.May(place, [this](std::size_t a, std::size_t b) { return conflicts_.Conflict(a, b); });
}

void Exclusion::Leave(std::size_t place) noexcept {
  const std::size_t unit = board_.unit(place);
  board_.Leave(place);
  WakeOthers(place, unit);
}

void Exclusion::WakeOthers(std::size_t place, std::size_t unit) noexcept {
  if (!sleeps_) return;
  FullFence();
  board_.ForEachWaiting(
      place, unit, [this](std::size_t a, std::size_t b) { return conflicts_.Conflict(a, b); },
      [this](std::size_t other) { may_look_[other].Notify(); });
}

}  // namespace runnel::genom_execution
