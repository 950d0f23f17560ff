#include "plugins/genom_execution/exclusion.h"

namespace runnel::genom_execution {

ConflictMatrix::ConflictMatrix(const ComponentTable& component)
    : words_((component.units() + 63) / 64), bits_(component.units() * words_), has_any_(component.units()) {
  for (const auto& [a, b] : component.conflicts) {
    bits_[a * words_ + b / 64] |= std::uint64_t{1} << (b % 64);
    bits_[b * words_ + a / 64] |= std::uint64_t{1} << (a % 64);
    has_any_[a] = has_any_[b] = true;
  }
}

void Exclusion::Want(std::size_t place, std::size_t unit) noexcept {
  Cell& cell = cells_[place];
  cell.word.store(unit + 1, std::memory_order_seq_cst);
  const std::uint64_t ticket = next_ticket_.fetch_add(1, std::memory_order_seq_cst);
  cell.word.store(ticket << 16 | (unit + 1), std::memory_order_seq_cst);
  WakeOthers(place, unit);  // who looked while there was no ticket
}

bool Exclusion::May(std::size_t place) const noexcept {
  const std::uint64_t own = cells_[place].word.load(std::memory_order_relaxed);
  for (std::size_t other = 0; other < cells_.size(); ++other) {
    if (other == place) continue;
    const std::uint64_t word = cells_[other].word.load(std::memory_order_seq_cst);
    if (word != 0 && word >> 16 < own >> 16 && conflicts_.Conflict(UnitOf(own), UnitOf(word))) return false;
  }
  return true;
}

void Exclusion::Leave(std::size_t place) noexcept {
  const std::size_t unit = UnitOf(cells_[place].word.load(std::memory_order_relaxed));
  cells_[place].word.store(0, std::memory_order_seq_cst);
  WakeOthers(place, unit);
}

void Exclusion::WakeOthers(std::size_t place, std::size_t unit) noexcept {
  for (std::size_t other = 0; other < cells_.size(); ++other) {
    if (other == place) continue;
    Cell& cell = cells_[other];
    const std::uint64_t word = cell.word.load(std::memory_order_seq_cst);
    if (word != 0 && conflicts_.Conflict(unit, UnitOf(word))) cell.may_look.Notify();
  }
}

}  // namespace runnel::genom_execution
