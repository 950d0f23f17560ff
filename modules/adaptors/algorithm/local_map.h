#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

/// What is remembered of the world near the robot: a square window of cells in the world's frame
/// that follows the robot. A cell is unknown, known to be free, or holds one boundary point at its
/// exact place. The window wraps round: a cell entered anew overwrites the one that left on the
/// other side, so memory is bounded and nothing is ever moved. Allocates in the constructor only.
class LocalMap {
 public:
  /// The window is `kCellsAcross` cells wide, 9.6 m in all: a planner relies on everything seen
  /// within the laser's 4 m being remembered, also where the robot has turned away from it.
  static constexpr int kCellsAcross = 192;
  static constexpr double kCellSize = 0.05;  ///< m
  /// m; where boundaries are that are too near to measure (-infinity): at the body's very centre they would lie in no
  /// direction.
  static constexpr double kLeastDistance = 0.01;
  /// m; up to here from its centre to each side the window is surely valid.
  static constexpr double kReach = (kCellsAcross / 2 - 1) * kCellSize;

  LocalMap() : cells_(static_cast<std::size_t>(kCellsAcross) * kCellsAcross) { listed_.reserve(cells_.size()); }

  /// Moves the window, and where its points are seen from; in the world's frame. Call it before the others.
  void SetPose(const Pose2& pose) {
    centre_ = Position(pose);
    frame_ = BodyFrame(pose);
    ++poses_;
  }
  [[nodiscard]] bool Covers(Point2 point) const {
    return std::abs(point.x - centre_.x) < kReach && std::abs(point.y - centre_.y) < kReach;
  }

  /// A boundary point was seen here. Points outside the window are left out.
  void MarkBoundary(Point2 point) {
    if (!Covers(point)) return;
    const std::size_t slot = Slot(Index(point.x), Index(point.y));
    Cell& cell = cells_[slot];
    if (!cell.is_listed) listed_.push_back(slot);
    cell = {Index(point.x), Index(point.y), State::kBoundary, true, point, 0, {}};
  }
  /// There is nothing within the cell of this point.
  void MarkFree(Point2 point) {
    if (!Covers(point)) return;
    Cell& cell = cells_[Slot(Index(point.x), Index(point.y))];
    cell = {Index(point.x), Index(point.y), State::kFree, cell.is_listed, point, 0, {}};
  }
  /// There is nothing within those cells of a box that hold no boundary and of which
  /// `is_inside(centre)` is true.
  template <typename Predicate>
  void MarkFree(Point2 low, Point2 high, Predicate is_inside) {
    for (int row = Index(low.y); row <= Index(high.y); ++row) {
      for (int column = Index(low.x); column <= Index(high.x); ++column) {
        const Point2 centre{(column + 0.5) * kCellSize, (row + 0.5) * kCellSize};
        if (is_inside(centre) && !IsBoundary(centre)) MarkFree(centre);
      }
    }
  }
  [[nodiscard]] bool IsFree(Point2 point) const { return Is(State::kFree, point); }
  [[nodiscard]] bool IsUnseen(Point2 point) const { return !IsFree(point) && !IsBoundary(point); }
  [[nodiscard]] bool IsBoundary(Point2 point) const { return Is(State::kBoundary, point); }

  /// Calls `is_refuted(point)` for every boundary point within the window, in a fixed order, and
  /// forgets those for which it says true.
  template <typename Refutation>
  void ForgetBoundaries(Refutation is_refuted) {
    ForgetCells([&](const Cell& cell) { return is_refuted(cell.point); });
  }
  /// The same with what is_refuted(BoundaryPoint) is told as it is seen from the pose.
  template <typename Refutation>
  void ForgetSeenBoundaries(Refutation is_refuted) {
    ForgetCells([&](Cell& cell) { return is_refuted(Seen(cell)); });
  }
  /// Calls `visit(point)` for every boundary point within the window, in a fixed order.
  template <typename Visitor>
  void ForEachBoundary(Visitor visit) const {
    ForEachBoundaryOf(*this, [&](const Cell& cell) { visit(cell.point); });
  }
  /// Every boundary point within the window, as it is seen from the pose.
  void AddBoundariesTo(Surroundings& surroundings) {
    ForEachBoundaryOf(*this, [&](Cell& cell) { AddBoundaryPoint(surroundings, Seen(cell)); });
  }

 private:
  enum class State : std::uint8_t { kUnknown, kFree, kBoundary };
  struct Cell {
    int column = 0;
    int row = 0;
    State state = State::kUnknown;
    bool is_listed = false;
    Point2 point;
    std::uint64_t seen_from = 0;  // the number of the pose that `seen` is true for
    BoundaryPoint seen;
  };

  template <typename Map, typename Visitor>
  static void ForEachBoundaryOf(Map& map, Visitor visit) {
    for (const std::size_t slot : map.listed_) {
      auto& cell = map.cells_[slot];
      if (cell.state == State::kBoundary && map.Covers(cell.point)) visit(cell);
    }
  }
  template <typename Refutation>
  void ForgetCells(Refutation is_refuted) {
    std::size_t kept = 0;
    for (const std::size_t slot : listed_) {
      Cell& cell = cells_[slot];
      if (cell.state == State::kBoundary && Covers(cell.point) && is_refuted(cell)) {
        cell.state = State::kFree;
      }
      cell.is_listed = cell.state == State::kBoundary;
      if (cell.is_listed) listed_[kept++] = slot;
    }
    listed_.resize(kept);
  }
  // Reckoned once for each pose: an arc tangent takes longer than all the rest that is done with a point.
  const BoundaryPoint& Seen(Cell& cell) {
    if (cell.seen_from != poses_) {
      const Point2 local = frame_.ToBody(cell.point);
      // Near enough that nothing overflows, for which std::hypot() provides.
      cell.seen = {std::sqrt(Dot(local, local)), Direction(local)};
      cell.seen_from = poses_;
    }
    return cell.seen;
  }

  static int Index(double coordinate) { return static_cast<int>(std::floor(coordinate / kCellSize)); }
  static std::size_t Slot(int column, int row) {
    const auto wrap = [](int index) {
      return static_cast<std::size_t>(((index % kCellsAcross) + kCellsAcross) % kCellsAcross);
    };
    return wrap(row) * kCellsAcross + wrap(column);
  }
  bool Is(State state, Point2 point) const {
    const int column = Index(point.x), row = Index(point.y);
    const Cell& cell = cells_[Slot(column, row)];
    return cell.state == state && cell.column == column && cell.row == row;
  }

  std::vector<Cell> cells_;
  /// Slots of all cells that hold a boundary, each once, and of some that do no more.
  std::vector<std::size_t> listed_;
  Point2 centre_;
  BodyFrame frame_{Pose2{}};
  std::uint64_t poses_ = 1;  // how many there have been
};

}  // namespace runnel
