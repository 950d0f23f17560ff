#include <array>
#include <cstddef>
#include <vector>

#include "modules/worlds/algorithm/internal/generated_worlds.h"

namespace runnel::internal {

namespace {

constexpr double kThickness = 0.2;         // m, of walls
constexpr double kLoopsPerWall = 1. / 12;  // of the walls that the tree leaves, so many fall

struct Cell {
  int column;
  int row;
};

/// A grid of cells, all joined: first by a random tree, found by depth-first search, then by a few
/// more doors, so that there is more than one way.
class Maze {
 public:
  Maze(const GeneratorOptions& options, Random& random)
      : options_(options),
        random_(random),
        columns_(Cells(options.width, options.gap)),
        rows_(Cells(options.height, options.gap)),
        pitch_(std::min(options.width / columns_, options.height / rows_)),
        is_joined_right_(Count()),
        is_joined_up_(Count()) {
    GrowTree();
    FellWalls();
  }

  World Make() {
    World world;
    world.bounds = Ring{Corner(0, 0), Corner(columns_, 0), Corner(columns_, rows_), Corner(0, rows_)};
    const Point2 start = Middle({0, random_.Below(rows_)});
    world.start = {start.x, start.y, 0.0};
    const Cell last{columns_ - 1, random_.Below(rows_)};
    world.goal = Middle(last);
    if (options_.is_enclosed) Close(last);
    AddWalls(world);
    return world;
  }

 private:
  static int Cells(double size, double gap) {
    return static_cast<int>(size / (gap + kThickness + 2 * kRoundingMargin));
  }
  std::size_t Count() const { return static_cast<std::size_t>(columns_ * rows_); }
  std::size_t Index(Cell cell) const { return static_cast<std::size_t>(cell.row * columns_ + cell.column); }
  bool IsInside(Cell cell) const {
    return cell.column >= 0 && cell.column < columns_ && cell.row >= 0 && cell.row < rows_;
  }
  Point2 Corner(int column, int row) const {
    return Rounded({pitch_ * (column - columns_ / 2.0), pitch_ * (row - rows_ / 2.0)});
  }
  Point2 Middle(Cell cell) const {
    return Rounded(0.5 * (Corner(cell.column, cell.row) + Corner(cell.column + 1, cell.row + 1)));
  }

  void Close(Cell cell) {
    is_joined_right_[Index(cell)] = is_joined_up_[Index(cell)] = false;
    if (cell.column > 0) is_joined_right_[Index({cell.column - 1, cell.row})] = false;
    if (cell.row > 0) is_joined_up_[Index({cell.column, cell.row - 1})] = false;
  }

  void Join(Cell from, int direction) {
    if (direction == 0) is_joined_right_[Index(from)] = true;
    if (direction == 1) is_joined_up_[Index(from)] = true;
    if (direction == 2) is_joined_right_[Index({from.column - 1, from.row})] = true;
    if (direction == 3) is_joined_up_[Index({from.column, from.row - 1})] = true;
  }

  void GrowTree() {
    constexpr std::array<Cell, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    std::vector<bool> is_visited(Count());
    std::vector<Cell> trail{{random_.Below(columns_), random_.Below(rows_)}};
    is_visited[Index(trail.back())] = true;
    while (!trail.empty()) {
      const Cell here = trail.back();
      std::array<int, 4> ways{};
      int count = 0;
      for (int i = 0; i < 4; ++i) {
        const Cell next{here.column + kSteps[static_cast<std::size_t>(i)].column,
                        here.row + kSteps[static_cast<std::size_t>(i)].row};
        if (IsInside(next) && !is_visited[Index(next)]) ways[static_cast<std::size_t>(count++)] = i;
      }
      if (count == 0) {
        trail.pop_back();
        continue;
      }
      const int way = ways[static_cast<std::size_t>(random_.Below(count))];
      Join(here, way);
      const Cell step = kSteps[static_cast<std::size_t>(way)];
      trail.push_back({here.column + step.column, here.row + step.row});
      is_visited[Index(trail.back())] = true;
    }
  }

  void FellWalls() {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const Cell cell{column, row};
        if (column + 1 < columns_ && random_.Between(0.0, 1.0) < kLoopsPerWall) Join(cell, 0);
        if (row + 1 < rows_ && random_.Between(0.0, 1.0) < kLoopsPerWall) Join(cell, 1);
      }
    }
  }

  /// Straight pieces, each as long as it can be.
  void AddWalls(World& world) const {
    const auto add = [&world](int lines, int length, const auto& is_joined, const auto& corner) {
      for (int line = 1; line < lines; ++line) {
        int first = 0;
        for (int at = 0; at <= length; ++at) {
          if (at < length && !is_joined(line, at)) continue;
          const Point2 from = corner(line, first), to = corner(line, at);
          if (from != to) world.walls.push_back({.points = {from, to}, .thickness = kThickness});
          first = at + 1;
        }
      }
    };
    add(
        columns_, rows_,
        [this](int line, int at) {
          return is_joined_right_[Index({line - 1, at})];
        },
        [this](int line, int at) { return Corner(line, at); });
    add(
        rows_, columns_,
        [this](int line, int at) {
          return is_joined_up_[Index({at, line - 1})];
        },
        [this](int line, int at) { return Corner(at, line); });
  }

  const GeneratorOptions& options_;
  Random& random_;
  const int columns_, rows_;
  const double pitch_;  // m, from cell to cell
  std::vector<bool> is_joined_right_, is_joined_up_;
};

}  // namespace

World MakeMaze(const GeneratorOptions& options, Random& random) { return Maze(options, random).Make(); }

}  // namespace runnel::internal
