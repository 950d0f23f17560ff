#include "core/types/builtin_types.h"

#include <bit>
#include <charconv>
#include <limits>
#include <type_traits>

#include "core/types/binary_encoding.h"
#include "core/types/duration_text.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

template <std::size_t size>
using UnsignedOf = std::conditional_t<
    size == 1, std::uint8_t,
    std::conditional_t<size == 2, std::uint16_t,
                       std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

template <typename N>
void WriteNumber(const void* value, BinaryWriter& writer) {
  writer.WriteUnsigned(std::bit_cast<UnsignedOf<sizeof(N)>>(*static_cast<const N*>(value)));
}
template <typename N>
bool ReadNumber(BinaryReader& reader, void* value) {
  UnsignedOf<sizeof(N)> bits;
  if (!reader.ReadUnsigned(bits)) return false;
  *static_cast<N*>(value) = std::bit_cast<N>(bits);
  return true;
}

template <typename N>
std::string NumberText(const void* value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, *static_cast<const N*>(value));
  return {buffer, end.ptr};
}

template <typename N>
Error OutOfRange(std::string_view text, const std::string& name) {
  Error error{.message = "'" + std::string(text) + "' does not fit into " + name};
  if constexpr (std::is_integral_v<N>) {
    error.hint = "allowed is " + std::to_string(std::numeric_limits<N>::lowest()) + " .. " +
                 std::to_string(std::numeric_limits<N>::max());
  }
  return error;
}

template <typename N>
Result<void> NumberFromText(std::string_view text, void* value) {
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  N number{};
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const std::string& name = TypeOf<N>().name();
  if (read.ec == std::errc::result_out_of_range) return OutOfRange<N>(text, name);
  if (read.ec != std::errc() || read.ptr != digits.data() + digits.size()) {
    return Error{.message = "'" + std::string(text) + "' is no " +
                            (std::is_integral_v<N> ? "whole number" : "number")};
  }
  *static_cast<N*>(value) = number;
  return {};
}

template <typename N>
void DescribeNumber(TypeBuilder<N>& type, const char* name) {
  type.Name(name).Leaf(
      {NumberText<N>, NumberFromText<N>, WriteNumber<N>, ReadNumber<N>, /*needs_quotes=*/false});
}

std::string BoolText(const void* value) {
  return *static_cast<const bool*>(value) ? "true" : "false";
}
Result<void> BoolFromText(std::string_view text, void* value) {
  if (text != "true" && text != "false") {
    return Error{.message = "'" + std::string(text) + "' is neither true nor false"};
  }
  *static_cast<bool*>(value) = text == "true";
  return {};
}
void WriteBool(const void* value, BinaryWriter& writer) {
  writer.WriteUnsigned<std::uint8_t>(*static_cast<const bool*>(value) ? 1 : 0);
}
bool ReadBool(BinaryReader& reader, void* value) {
  std::uint8_t byte = 0;
  if (!reader.ReadUnsigned(byte) || byte > 1) return false;
  *static_cast<bool*>(value) = byte == 1;
  return true;
}

std::string StringText(const void* value) { return *static_cast<const std::string*>(value); }
Result<void> StringFromText(std::string_view text, void* value) {
  *static_cast<std::string*>(value) = text;
  return {};
}
void WriteString(const void* value, BinaryWriter& writer) {
  const auto& text = *static_cast<const std::string*>(value);
  writer.WriteUnsigned(static_cast<std::uint32_t>(text.size()));
  writer.WriteBytes(std::as_bytes(std::span(text)));
}
bool ReadString(BinaryReader& reader, void* value) {
  std::uint32_t size = 0;
  if (!reader.ReadUnsigned(size) || size > reader.remaining()) return false;
  auto& text = *static_cast<std::string*>(value);
  text.resize(size);
  return reader.ReadBytes(std::as_writable_bytes(std::span(text)));
}

std::string DurationToText(const void* value) {
  return DurationText(*static_cast<const Duration*>(value));
}
Result<void> DurationFromText(std::string_view text, void* value) {
  auto duration = ParseDuration(text);
  if (!duration) return duration.error();
  *static_cast<Duration*>(value) = *duration;
  return {};
}

constexpr LeafOperations kDurationOperations{DurationToText, DurationFromText,
                                             WriteNumber<std::int64_t>, ReadNumber<std::int64_t>,
                                             /*needs_quotes=*/false};

}  // namespace

void Describe(TypeBuilder<bool>& type) {
  type.Name("bool").Leaf({BoolText, BoolFromText, WriteBool, ReadBool, /*needs_quotes=*/false});
}
void Describe(TypeBuilder<std::int8_t>& type) { DescribeNumber(type, "int8"); }
void Describe(TypeBuilder<std::int16_t>& type) { DescribeNumber(type, "int16"); }
void Describe(TypeBuilder<std::int32_t>& type) { DescribeNumber(type, "int32"); }
void Describe(TypeBuilder<std::int64_t>& type) { DescribeNumber(type, "int64"); }
void Describe(TypeBuilder<std::uint8_t>& type) { DescribeNumber(type, "uint8"); }
void Describe(TypeBuilder<std::uint16_t>& type) { DescribeNumber(type, "uint16"); }
void Describe(TypeBuilder<std::uint32_t>& type) { DescribeNumber(type, "uint32"); }
void Describe(TypeBuilder<std::uint64_t>& type) { DescribeNumber(type, "uint64"); }
void Describe(TypeBuilder<float>& type) { DescribeNumber(type, "float"); }
void Describe(TypeBuilder<double>& type) { DescribeNumber(type, "double"); }
void Describe(TypeBuilder<std::string>& type) {
  type.Name("string").Leaf(
      {StringText, StringFromText, WriteString, ReadString, /*needs_quotes=*/true});
}

static_assert(sizeof(Duration) == sizeof(std::int64_t) && sizeof(Time) == sizeof(Duration),
              "durations and times are sent as their nanoseconds");
void Describe(TypeBuilder<Duration>& type) { type.Name("duration").Leaf(kDurationOperations); }
void Describe(TypeBuilder<Time>& type) { type.Name("time").Leaf(kDurationOperations); }

}  // namespace runnel
