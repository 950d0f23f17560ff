#include "core/types/builtin_types.h"

#include <charconv>
#include <limits>

#include "core/types/duration_text.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

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
    return Error{.message = "'" + std::string(text) + "' is no " + (std::is_integral_v<N> ? "whole number" : "number")};
  }
  *static_cast<N*>(value) = number;
  return {};
}

template <typename N>
void DescribeNumber(TypeBuilder<N>& type, const char* name) {
  type.Name(name).Leaf({NumberText<N>, NumberFromText<N>, /*needs_quotes=*/false});
}

std::string BoolText(const void* value) { return *static_cast<const bool*>(value) ? "true" : "false"; }
Result<void> BoolFromText(std::string_view text, void* value) {
  if (text != "true" && text != "false") {
    return Error{.message = "'" + std::string(text) + "' is neither true nor false"};
  }
  *static_cast<bool*>(value) = text == "true";
  return {};
}

std::string StringText(const void* value) { return *static_cast<const std::string*>(value); }
Result<void> StringFromText(std::string_view text, void* value) {
  *static_cast<std::string*>(value) = text;
  return {};
}

std::string DurationToText(const void* value) { return DurationText(*static_cast<const Duration*>(value)); }
Result<void> DurationFromText(std::string_view text, void* value) {
  auto duration = ParseDuration(text);
  if (!duration) return duration.error();
  *static_cast<Duration*>(value) = *duration;
  return {};
}

constexpr LeafOperations kDurationOperations{DurationToText, DurationFromText,
                                             /*needs_quotes=*/false};

}  // namespace

void Describe(TypeBuilder<bool>& type) { type.Name("bool").Leaf({BoolText, BoolFromText, /*needs_quotes=*/false}); }
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
  type.Name("string").Leaf({StringText, StringFromText, /*needs_quotes=*/true});
}

void Describe(TypeBuilder<Duration>& type) { type.Name("duration").Leaf(kDurationOperations); }
void Describe(TypeBuilder<Time>& type) { type.Name("time").Leaf(kDurationOperations); }

void Describe(TypeBuilder<Signal>& type) {
  type.Name("signal").Leaf({.to_text = [](const void*) { return std::string("now"); },
                            .from_text = [](std::string_view text, void*) -> Result<void> {
                              if (text.empty() || text == "now" || text == "{}") return {};
                              return Error{.message = "'" + std::string(text) + "' is no signal, which has no content",
                                           .hint = "write 'now'"};
                            },
                            .needs_quotes = false});
}

}  // namespace runnel
