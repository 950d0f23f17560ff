#include "plugins/ros_messages/internal/occupancy_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/internal/message_leaf.h"
#include "plugins/ros_messages/internal/message_number.h"

namespace runnel::internal {

namespace {

struct Place {
  double x, y;
};
using Line = std::vector<Place>;

constexpr double kCell = 0.05;  // m
constexpr double kMostCells = 2000;
constexpr double kFarthest = 1e6;  // m
constexpr std::int8_t kFree = 0, kOccupied = 100, kUnknown = -1;

double NumberIn(const TypeInfo& type, const void* value, std::string_view name) {
  const FieldInfo* const field = type.FindField(name);
  return static_cast<double>(NumberOf(*field->type, field->address(ForLooking(value))));
}

Line PointsIn(const TypeInfo& type, const void* value, std::string_view name) {
  const FieldInfo* const field = type.FindField(name);
  const ElementOperations& elements = field->type->elements();
  void* const list = field->address(ForLooking(value));
  Line line;
  for (std::size_t i = 0; i < elements.columns(list); ++i) {
    const void* const point = elements.element(list, i);
    const double x = NumberIn(*elements.type, point, "x"), y = NumberIn(*elements.type, point, "y");
    if (std::isnan(x) || std::isnan(y)) continue;
    line.push_back({std::clamp(x, -kFarthest, kFarthest), std::clamp(y, -kFarthest, kFarthest)});
  }
  return line;
}

bool HasPoints(const TypeInfo& type, std::string_view name) {
  const FieldInfo* const field = type.FindField(name);
  if (field == nullptr || field->type->kind() != TypeKind::kSequence) return false;
  const TypeInfo& point = *field->type->elements().type;
  return point.FindField("x") != nullptr && IsLeaf(*point.FindField("x")->type) &&
         point.FindField("y") != nullptr && IsLeaf(*point.FindField("y")->type);
}

class Grid {
 public:
  Grid(Place low, Place high) : low_(low) {
    const double width = high.x - low.x, height = high.y - low.y;
    cell_ = std::max(kCell, std::max(width, height) / kMostCells);
    columns_ = static_cast<std::size_t>(std::ceil(width / cell_)) + 1;
    rows_ = static_cast<std::size_t>(std::ceil(height / cell_)) + 1;
    cells_.assign(columns_ * rows_, kFree);
  }

  // Row by row between where the closed line crosses the middle of the cells.
  void Fill(const Line& line, std::int8_t as, bool is_outside) {
    for (std::size_t row = 0; row < rows_; ++row) {
      const double y = low_.y + (static_cast<double>(row) + 0.5) * cell_;
      std::vector<double> crossings;
      for (std::size_t i = 0; i < line.size(); ++i) {
        const Place a = line[i], b = line[(i + 1) % line.size()];
        if ((a.y <= y) != (b.y <= y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
      std::ranges::sort(crossings);
      std::size_t next = 0;
      for (std::size_t column = 0; column < columns_; ++column) {
        const double x = low_.x + (static_cast<double>(column) + 0.5) * cell_;
        while (next < crossings.size() && crossings[next] < x) ++next;
        if ((next % 2 == 1) != is_outside) cells_[row * columns_ + column] = as;
      }
    }
  }

  // The closed line itself, for walls that are thinner than a cell.
  void Draw(const Line& line) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Place a = line[i], b = line[(i + 1) % line.size()];
      const auto steps = static_cast<std::size_t>(std::hypot(b.x - a.x, b.y - a.y) / cell_ * 2) + 1;
      for (std::size_t step = 0; step <= steps; ++step) {
        const double part = static_cast<double>(step) / static_cast<double>(steps);
        const auto column = static_cast<std::size_t>((a.x + part * (b.x - a.x) - low_.x) / cell_);
        const auto row = static_cast<std::size_t>((a.y + part * (b.y - a.y) - low_.y) / cell_);
        cells_[std::min(row, rows_ - 1) * columns_ + std::min(column, columns_ - 1)] = kOccupied;
      }
    }
  }

  void Write(Time stamp, CdrWriter& writer) const {
    WriteCdr(TypeOf<Time>(), &stamp, writer);  // since when the map is known
    writer.Put(static_cast<float>(cell_));
    writer.PutCount(columns_);
    writer.PutCount(rows_);
    for (const double each : {low_.x, low_.y, 0.0, 0.0, 0.0, 0.0, 1.0}) writer.Put(each);
    writer.PutCount(cells_.size());
    writer.PutPlain(cells_.data(), 1, cells_.size());
  }

 private:
  Place low_;
  double cell_;
  std::size_t columns_, rows_;
  std::vector<std::int8_t> cells_;
};

}  // namespace

bool CanBecomeGrid(const TypeInfo& type) {
  const FieldInfo* const outlines = type.FindField("outlines");
  return type.semantic_tag() == "world_map" && HasPoints(type, "bounds") && outlines != nullptr &&
         outlines->type->kind() == TypeKind::kSequence && HasPoints(*outlines->type->elements().type, "points");
}

void WriteGrid(const TypeInfo& type, const void* map, Time stamp, const std::string& frame,
               std::vector<std::byte>& octets) {
  const FieldInfo* const field = type.FindField("outlines");
  const ElementOperations& elements = field->type->elements();
  const FieldInfo* const hole = elements.type->FindField("is_hole");
  void* const list = field->address(ForLooking(map));
  const Line bounds = PointsIn(type, map, "bounds");
  std::vector<Line> outlines;
  for (std::size_t i = 0; i < elements.columns(list); ++i) {
    outlines.push_back(PointsIn(*elements.type, elements.element(list, i), "points"));
  }

  constexpr double kMost = std::numeric_limits<double>::max();
  Place low{kMost, kMost}, high{-kMost, -kMost};
  const auto include = [&](const Line& line) {
    for (const Place& each : line) {
      low = {std::min(low.x, each.x), std::min(low.y, each.y)};
      high = {std::max(high.x, each.x), std::max(high.y, each.y)};
    }
  };
  include(bounds);
  std::ranges::for_each(outlines, include);
  if (low.x > high.x) low = high = {0, 0};

  Grid grid(low, high);
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    const void* const outline = elements.element(list, i);
    const bool is_hole = hole != nullptr && NumberOf(*hole->type, hole->address(ForLooking(outline))) != 0;
    grid.Fill(outlines[i], is_hole ? kFree : kOccupied, false);
    grid.Draw(outlines[i]);
  }
  if (!bounds.empty()) grid.Fill(bounds, kUnknown, true);
  grid.Draw(bounds);

  CdrWriter writer(octets);
  WriteCdr(TypeOf<Time>(), &stamp, writer);
  writer.PutText(frame);
  grid.Write(stamp, writer);
}

}  // namespace runnel::internal
