#pragma once

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

class NoRevisit final : public Revisit {
 public:
  [[nodiscard]] std::string_view name() const override { return "none"; }
  [[nodiscard]] bool ShallReverse(const BugView&) const override { return false; }
};

/// Reverses where it meets an earlier hit or leave point (Alg1, Sankaranarayanan and Vidyasagar
/// 1990). Only points of the lists in BugState are known.
class ReverseAtVisited final : public Revisit {
 public:
  [[nodiscard]] std::string_view name() const override { return "reverse_at_visited"; }
  [[nodiscard]] bool ShallReverse(const BugView& view) const override;

  /// m; less than half of what two grown boundaries are apart that a robot passes between (0.30 m
  /// with gaps of its diameter and two safe distances), more than two passes of the same one.
  static constexpr double kMeeting = 0.15;
};

}  // namespace runnel
