#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/types/eigen_types.h"
#include "core/types/type_of.h"
#include "plugins/values/json_values.h"

/// One type of each kind, all in one structure.
namespace example {

enum class Side : std::uint8_t { kLeft, kRight = 7 };

struct Point {
  double x = 1.0;
  double y = 2.0;
  friend bool operator==(const Point&, const Point&) = default;
};

/// Has a text format of its own, as file paths do.
struct Label {
  std::string text;
  friend bool operator==(const Label&, const Label&) = default;
};

struct Everything {
  bool is_closed = false;
  std::int8_t i8 = 0;
  std::int16_t i16 = 0;
  std::int32_t i32 = 0;
  std::int64_t i64 = 0;
  std::uint8_t u8 = 0;
  std::uint16_t u16 = 0;
  std::uint32_t u32 = 0;
  std::uint64_t u64 = 0;
  float small = 0;
  double large = 0;
  std::string text;
  runnel::Duration age{};
  runnel::Time timestamp{};
  Side side = Side::kLeft;
  Label label;
  std::vector<Point> points;
  std::vector<std::vector<std::string>> words;
  std::array<std::int16_t, 2> counts{};
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::VectorXd state;
  Eigen::Matrix<double, 2, 3> fixed = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::MatrixXd free;
  std::vector<Everything> branches;
};

inline void Describe(runnel::TypeBuilder<Point>& type) {
  type.Name("Point").Field("x", &Point::x, {.unit = "m", .description = "to the east"});
  type.Field("y", &Point::y, {.unit = "m", .description = ""});
}
inline void Describe(runnel::TypeBuilder<Side>& type) {
  type.Name("Side").Value("left", Side::kLeft).Value("right", Side::kRight);
}
inline void Describe(runnel::TypeBuilder<Label>& type) {
  type.Name("Label").Leaf({[](const void* at) { return static_cast<const Label*>(at)->text; },
                           [](std::string_view text, void* at) -> runnel::Result<void> {
                             if (text == "bad")
                               return runnel::Error{.message = "'bad' is no label", .hint = "try good"};
                             static_cast<Label*>(at)->text = text;
                             return {};
                           },
                           /*needs_quotes=*/true});
}
inline void Describe(runnel::TypeBuilder<Everything>& type) {
  type.Name("Everything")
      .Field("is_closed", &Everything::is_closed)
      .Field("i8", &Everything::i8)
      .Field("i16", &Everything::i16)
      .Field("i32", &Everything::i32)
      .Field("i64", &Everything::i64)
      .Field("u8", &Everything::u8)
      .Field("u16", &Everything::u16)
      .Field("u32", &Everything::u32)
      .Field("u64", &Everything::u64)
      .Field("small", &Everything::small)
      .Field("large", &Everything::large)
      .Field("text", &Everything::text)
      .Field("age", &Everything::age)
      .Field("stamp", &Everything::timestamp)
      .Field("side", &Everything::side)
      .Field("label", &Everything::label)
      .Field("points", &Everything::points)
      .Field("words", &Everything::words)
      .Field("counts", &Everything::counts)
      .Field("offset", &Everything::offset)
      .Field("state", &Everything::state)
      .Field("fixed", &Everything::fixed)
      .Field("free", &Everything::free)
      .Field("branches", &Everything::branches);
}

}  // namespace example

namespace runnel::test {

template <typename T>
std::string JsonOf(const T& value, const JsonLimits& limits = {}) {
  std::string json;
  AppendJson(TypeOf<T>(), &value, json, limits);
  return json;
}

template <typename T>
T Read(std::string_view json) {
  T value{};
  const auto read = SetFromJson(TypeOf<T>(), json, &value);
  EXPECT_TRUE(read) << (read ? "" : read.error().ToString()) << "\n" << json;
  return value;
}

/// "message | hint"; of what is no JSON at all, "line:column message".
template <typename T>
std::string WhyNot(std::string_view json) {
  T value{};
  const auto read = SetFromJson(TypeOf<T>(), json, &value);
  if (read) return "it could be read";
  const Error& error = read.error();
  const SourcePosition& at = error.position;
  return (at.line == 0 ? "" : std::to_string(at.line) + ":" + std::to_string(at.column) + " ") + error.message +
         (error.hint.empty() ? "" : " | " + error.hint);
}

}  // namespace runnel::test
