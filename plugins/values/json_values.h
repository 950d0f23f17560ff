#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

class JsonPart;
class TypeInfo;

/// How much of a value a viewer wants. What is beyond is left out, and the rest is JSON of the same
/// shape: lists have their first elements only, texts end in "…".
struct JsonLimits {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  std::size_t elements = kNone;    ///< of each list
  std::size_t characters = kNone;  ///< of each text, in bytes
  /// Of the whole, roughly: once so many bytes are there, lists end and texts are empty.
  std::size_t bytes = kNone;
  /// Whether infinities are 1e999; else null. Some readers (nlohmann-json, RapidJSON, serde) refuse the
  /// whole text for a number that large.
  bool has_infinity = true;
};

/// Values as JSON, for programs that were compiled without their types:
///
///     bool, numbers   true   -3   0.25     numbers in the fewest digits that read back the same
///     NaN, infinity   null   1e999 -1e999  which browsers and most others read as infinity
///     string          "…"                  what is no UTF-8 becomes U+FFFD
///     duration, time  {"sec":-1,"nsec":500000000}      nsec from 0 to 999999999
///     enumeration     "left"               a value that nobody named: its number
///     structure       {"x":1,"y":2}        all fields, in the order of their description
///     sequence        [1,2,3]
///     matrix          [[1,2],[3,4]]        row by row
///     opaque          null
///
/// Appends the JSON of the value at `value`, an object of the type. Returns whether all of it is
/// there, false if a limit has cut something.
/// Threads: as for the object. Allocates what `json` needs; and for leaves that are none of the above.
bool AppendJson(const TypeInfo& type, const void* value, std::string& json, const JsonLimits& limits = {});

/// The way back: sets `value` from what AppendJson() has written without limits, or what somebody
/// wrote by hand. Strict JSON (RFC 8259), in UTF-8. Fields that are left out stay as they are;
/// elements of lists begin as the type makes them.
/// Errors:   say what is wrong, of which field ("points[2].x") with the nearest name that would have
///           been right; or where the text is no JSON, in Error::position the line and the column (bytes, from
///           1). The value may then be half set, so work on a copy. Nesting is limited to 100 levels, lists to
///           256 MiB together.
Result<void> SetFromJson(const TypeInfo& type, std::string_view json, void* value);
Result<void> SetFromJson(const TypeInfo& type, const JsonPart& json, void* value);

/// What AppendJson() writes for the type, as JSON Schema that is good for draft 7 and 2020-12:
/// units and descriptions in "description", "nullable" (an OpenAPI word, which validators know) for
/// numbers that may be NaN. Types that contain themselves are told once; inside they are objects of any
/// content.
[[nodiscard]] std::string JsonSchemaOf(const TypeInfo& type);

}  // namespace runnel
