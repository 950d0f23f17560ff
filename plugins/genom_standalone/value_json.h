#pragma once

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "plugins/genom_standalone/value_type.h"

namespace runnel::genom_standalone {

using Json = nlohmann::ordered_json;

/// Structs as objects, sequences as arrays, an optional without a value as null, a union as an object of what is set,
/// enumerators and texts as texts.
[[nodiscard]] Json ToJson(const ValueType& type, const void* value);

/// What is not said stays as it is. Errors: what is of another type, does not fit, or is unknown, with its path; parts may
/// have been set then.
[[nodiscard]] Result<void> FromJson(const ValueType& type, const Json& json, void* value, const std::string& path);

}  // namespace runnel::genom_standalone
