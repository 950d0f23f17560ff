#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "modules/planning/algorithm/bug_view.h"

namespace runnel {

/// Component of a Bug algorithm: what the robot does where it has been before. Objects have no
/// state; they outlive the algorithms made of them.
class Revisit {
 public:
  virtual ~Revisit() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Whether to go back to the last hit point and round the obstacle the other way. Asked in each
  /// step along a boundary, until it says so for the first time since the hit.
  [[nodiscard]] virtual bool ShallReverse(const BugView& view) const = 0;
};

enum class RevisitKind : std::uint8_t {
  kNone,
  /// Reverses where it meets an earlier hit or leave point (Alg1, Sankaranarayanan and Vidyasagar
  /// 1990). Only points of the lists in BugState are known.
  kReverseAtVisited,
};
/// By kind.
[[nodiscard]] std::span<const Revisit* const> AllRevisits();

}  // namespace runnel
