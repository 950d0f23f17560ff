#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/base/clock.h"
#include "core/types/leaf_types.h"
#include "core/types/type_info.h"
#include "plugins/values/foxglove_channel.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

/// A value that is only looked at, by its description. Whoever asks for a field, an element or a number has made
/// sure that the type has it.
class ValueView {
 public:
  ValueView(const TypeInfo& type, const void* value) : type_(&type), value_(ForLooking(value)) {}

  [[nodiscard]] const TypeInfo& type() const noexcept { return *type_; }
  [[nodiscard]] const void* value() const noexcept { return value_; }
  [[nodiscard]] ValueView Field(std::string_view name) const {
    const FieldInfo* const field = type_->FindField(name);
    return {*field->type, field->address(value_)};
  }
  [[nodiscard]] std::size_t size() const { return type_->elements().columns(value_); }
  [[nodiscard]] ValueView operator[](std::size_t index) const {
    return {*type_->elements().type, type_->elements().element(value_, index)};
  }
  [[nodiscard]] double number() const {
    return WithLeafType(*type_, [this]<typename T>(std::type_identity<T>) -> double {
      if constexpr (std::is_arithmetic_v<T>) return static_cast<double>(*static_cast<const T*>(value_));
      return 0;
    });
  }

 private:
  const TypeInfo* type_;
  void* value_;
};

[[nodiscard]] inline bool IsNumber(const TypeInfo& type) {
  return type.kind() == TypeKind::kLeaf && WithLeafType(type, []<typename T>(std::type_identity<T>) {
           return std::is_arithmetic_v<T> && !std::same_as<T, bool>;
         });
}

/// Whether it is a structure with numbers of these names.
[[nodiscard]] inline bool HasNumbers(const TypeInfo& type, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const FieldInfo* const field = type.FindField(name);
    if (field == nullptr || !IsNumber(*field->type)) return false;
  }
  return true;
}

/// What the list of this name has as elements; nullptr if there is no such list.
[[nodiscard]] inline const TypeInfo* ElementsOf(const TypeInfo& type, std::string_view list) {
  const FieldInfo* const field = type.FindField(list);
  const bool is_list = field != nullptr && field->type->kind() == TypeKind::kSequence;
  return is_list ? field->type->elements().type : nullptr;
}

/// What poses, points, paths and maps are told in; and scans.
inline constexpr std::string_view kWorldFrame = "world", kBodyFrame = "robot";

/// How values of types with a meaning are told in one of Foxglove's own schemas.
struct Drawing {
  std::string_view tag;     ///< the meaning
  std::string_view schema;  ///< without "foxglove."
  /// Whether the type has the fields that its meaning promises.
  bool (*fits)(const TypeInfo& type);
  void (*append)(const ValueView& value, Time timestamp, std::string& json);
};

extern const Drawing kPoseDrawing, kTransformDrawing, kPathDrawing;
extern const Drawing kRangeScanDrawing, kImageDrawing;
extern const Drawing kPointDrawing, kHitAndLeavePointsDrawing, kDrawingDrawing, kWorldMapDrawing;

/// The JSON Schema of one of Foxglove's messages (github.com/foxglove/schemas), without the descriptions.
[[nodiscard]] std::string FoxgloveSchema(std::string_view name);

// The pieces that Foxglove's messages are made of. Each function that appends appends one JSON value.

struct Colour {
  double red, green, blue, alpha = 1.0;
};
struct Place {
  double x = 0;
  double y = 0;
  double z = 0;
};
struct PlaceAndHeading {
  Place place;
  double heading = 0;  // rad
};

/// Anything with x and y, and perhaps z.
[[nodiscard]] inline bool IsPlace(const TypeInfo& type) { return HasNumbers(type, {"x", "y"}); }

/// A place with a heading.
[[nodiscard]] inline bool IsPose(const TypeInfo& type) { return HasNumbers(type, {"x", "y", "heading"}); }

/// Whether a structure has a list of places of this name.
[[nodiscard]] inline bool HasPlaces(const TypeInfo& type, std::string_view list) {
  const TypeInfo* const element = ElementsOf(type, list);
  return element != nullptr && IsPlace(*element);
}

[[nodiscard]] inline Place PlaceOf(const ValueView& value) {
  const bool has_height = HasNumbers(value.type(), {"z"});
  return {value.Field("x").number(), value.Field("y").number(), has_height ? value.Field("z").number() : 0.0};
}

[[nodiscard]] inline PlaceAndHeading PoseOf(const ValueView& value) {
  return {PlaceOf(value), value.Field("heading").number()};
}

/// Times before the clock's start are told as its start: Foxglove knows no others.
inline void AppendTime(Time time, std::string& json) {
  const std::int64_t since_start = std::max<std::int64_t>(0, time.time_since_epoch().count());
  JsonObject(json).Add("sec", since_start / 1'000'000'000).Add("nsec", since_start % 1'000'000'000);
}

inline void AppendVector(const Place& place, std::string& json) {
  JsonObject(json).Add("x", place.x).Add("y", place.y).Add("z", place.z);
}

/// The turn by `heading` (rad) about the vertical.
inline void AppendTurn(double heading, std::string& json) {
  const double half = heading / 2;
  JsonObject(json).Add("x", 0.0).Add("y", 0.0).Add("z", std::sin(half)).Add("w", std::cos(half));
}

inline void AppendPose(const PlaceAndHeading& pose, std::string& json) {
  JsonObject object(json);
  AppendVector(pose.place, object.Key("position"));
  AppendTurn(pose.heading, object.Key("orientation"));
}

inline void AppendColour(const Colour& colour, std::string& json) {
  JsonObject object(json);
  object.Add("r", colour.red).Add("g", colour.green).Add("b", colour.blue).Add("a", colour.alpha);
}

}  // namespace runnel::internal
