#pragma once

#include <utility>

namespace runnel {

/// std::erase_if() for what may throw: those that `is_over` has said so of are gone then, all others stay, and none is
/// left that has been moved from. For vectors and deques, of elements that are moved without an exception.
template <typename Sequence, typename IsOver>
void EraseWhere(Sequence& all, const IsOver& is_over) {
  auto next = all.begin(), kept = all.begin();
  const struct Gap {
    ~Gap() { of.erase(begin, end); }
    Sequence& of;
    decltype(next)&begin, &end;
  } gap{all, kept, next};
  for (; next != all.end(); ++next) {
    if (is_over(*next)) continue;
    if (kept != next) *kept = std::move(*next);
    ++kept;
  }
}

}  // namespace runnel
