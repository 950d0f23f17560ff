#include "plugins/ros_messages/message_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/types/type_info.h"
#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/internal/binding.h"
#include "plugins/ros_messages/internal/message_leaf.h"
#include "plugins/ros_messages/internal/message_number.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

class NamedCodec : public MessageCodec {
 protected:
  NamedCodec(const MessageDefinition& definition, const MessageLibrary& library) {
    ros_type_ = definition.name;
    dds_type_ = DdsType(definition.name);
    type_hash_ = TypeHashOf(definition, library);
  }
};

/// The octets are those of the type's own description.
class DescribedCodec final : public NamedCodec {
 public:
  DescribedCodec(const TypeInfo& type, const MessageDefinition& definition, const MessageLibrary& library)
      : NamedCodec(definition, library), type_(type) {}

  void Encode(const void* value, Time /*stamp*/, std::vector<std::byte>& octets) const override {
    WriteCdr(type_, value, octets);
  }
  [[nodiscard]] Result<Decoded> Decode(std::span<const std::byte> octets, void* value,
                                       std::shared_ptr<const void> holder) const override {
    if (auto read = ReadCdr(type_, octets, value, std::move(holder)); !read) return read.error();
    return Decoded{};
  }

 private:
  const TypeInfo& type_;
};

/// The message has fields of its own, of which the value fills some.
class BoundCodec final : public NamedCodec {
 public:
  BoundCodec(const TypeInfo& type, internal::Binding binding, const MessageDefinition& definition,
             const MessageLibrary& library)
      : NamedCodec(definition, library), root_(std::move(binding.root)), fresh_(type.Make()) {
    left_out_ = std::move(binding.left_out);
    why_no_decoding_ = std::move(binding.why_no_decoding);
  }

  void Encode(const void* value, Time stamp, std::vector<std::byte>& octets) const override {
    CdrWriter writer(octets);
    internal::WriteBySteps(root_, value, stamp, writer);
  }
  [[nodiscard]] Result<Decoded> Decode(std::span<const std::byte> octets, void* value,
                                       std::shared_ptr<const void> holder) const override {
    if (!why_no_decoding_.empty()) return Error{.message = why_no_decoding_};
    auto reader = CdrReader::Begin(octets, std::move(holder));
    if (!reader) return reader.error();
    Decoded decoded;
    auto read = internal::ReadBySteps(root_, *reader, fresh_.get(), value, decoded.stamp);
    if (!read) return read.error();
    return decoded;
  }

 private:
  const internal::Step root_;
  const std::shared_ptr<const void> fresh_;
};

constexpr std::string_view kGridMessage = "nav_msgs/msg/OccupancyGrid";

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
  return static_cast<double>(internal::NumberOf(*field->type, field->address(ForLooking(value))));
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
  return point.FindField("x") != nullptr && internal::IsLeaf(*point.FindField("x")->type) &&
         point.FindField("y") != nullptr && internal::IsLeaf(*point.FindField("y")->type);
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

/// Whether the type has the fields of the meaning `world_map` that a grid is made of.
bool CanBecomeGrid(const TypeInfo& type) {
  const FieldInfo* const outlines = type.FindField("outlines");
  return type.semantic_tag() == "world_map" && HasPoints(type, "bounds") && outlines != nullptr &&
         outlines->type->kind() == TypeKind::kSequence && HasPoints(*outlines->type->elements().type, "points");
}

/// Sets `octets` to the ground plan as nav_msgs/msg/OccupancyGrid: 100 within obstacles and on their outlines, 0 where
/// nothing is, -1 beyond the bounds. Cells have 5 cm, or more where a side would have more than 2000 of them.
/// Precondition: CanBecomeGrid(). Allocates.
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
    const bool is_hole = hole != nullptr && internal::NumberOf(*hole->type, hole->address(ForLooking(outline))) != 0;
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

/// A ground plan as a grid, out of which no plan comes back.
class GridCodec final : public NamedCodec {
 public:
  GridCodec(const TypeInfo& type, const MessageOptions& options, const MessageDefinition& definition,
            const MessageLibrary& library)
      : NamedCodec(definition, library), type_(type), frame_(options.frame) {
    why_no_decoding_ = "a grid has no outlines, of which a " + type.name() + " is made";
  }

  void Encode(const void* value, Time stamp, std::vector<std::byte>& octets) const override {
    WriteGrid(type_, value, stamp, frame_, octets);
  }
  [[nodiscard]] Result<Decoded> Decode(std::span<const std::byte> /*octets*/, void* /*value*/,
                                       std::shared_ptr<const void> /*holder*/) const override {
    return Error{.message = why_no_decoding_};
  }

 private:
  const TypeInfo& type_;
  const std::string frame_;
};

using Made = Result<std::shared_ptr<const MessageCodec>>;

Made MakeDescribed(const TypeInfo& type, const MessageLibrary& library) {
  MessageLibrary with_type = library;
  const auto definition = with_type.AddDescribed(type);
  if (!definition) return definition.error();
  return {std::make_shared<DescribedCodec>(type, **definition, with_type)};
}

Made MakeBound(const TypeInfo& type, const std::string& as, const MessageOptions& options,
               const MessageLibrary& library) {
  const auto definition = library.Get(as);
  if (!definition) return definition.error();
  const MessageField whole{.name = {}, .type = MessageType::kNested, .nested = (*definition)->name};
  const bool is_whole = options.field.empty();
  if (is_whole && internal::IsSame(whole, type, library)) {
    return {std::make_shared<DescribedCodec>(type, **definition, library)};
  }
  if (is_whole && (*definition)->name == kGridMessage && CanBecomeGrid(type)) {
    return {std::make_shared<GridCodec>(type, options, **definition, library)};
  }
  auto binding = (is_whole ? internal::Bind : internal::BindField)(**definition, type, options, library);
  if (!binding) return binding.error();
  return {std::make_shared<BoundCodec>(type, std::move(*binding), **definition, library)};
}

std::string DefaultMessageOf(const TypeInfo& type) {
  for (const internal::DefaultMessage& each : internal::kDefaultMessages) {
    if (each.semantic_tag == type.semantic_tag()) return std::string(each.message);
  }
  if (type.kind() == TypeKind::kSequence && type.elements().are_plain_numbers) {
    return MessageNameOf(*type.elements().type) + "MultiArray";
  }
  return "";
}

}  // namespace

Made MessageCodec::Make(const TypeInfo& type, const MessageOptions& options, const MessageLibrary& library) {
  if (auto checked = CheckCdr(type); !checked) return checked.error();
  if (!options.field.empty()) {
    if (!options.as.empty()) return MakeBound(type, options.as, options, library);
    return Error{.message = "the field '" + options.field + "' is one of a message, and nobody says of which",
                 .hint = "say it: as=\"sensor_msgs/msg/BatteryState\""};
  }
  if (options.by_description) return MakeDescribed(type, library);
  if (!options.as.empty()) {
    const bool is_own = library.Find(options.as) == nullptr && options.as == MessageNameOf(type);
    return is_own ? MakeDescribed(type, library) : MakeBound(type, options.as, options, library);
  }
  const std::string fitting = DefaultMessageOf(type);
  const std::string& own = MessageNameOf(type);
  if (!fitting.empty()) {
    // Of a type that only claims the meaning, its description is as good.
    if (auto made = MakeBound(type, fitting, options, library)) return made;
  }
  return library.Find(own) == nullptr ? MakeDescribed(type, library) : MakeBound(type, own, options, library);
}

}  // namespace runnel
