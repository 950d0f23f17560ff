#pragma once

#include "core/base/result.h"
#include "plugins/structure/change.h"
#include "plugins/values/json_reader.h"

namespace runnel::internal {

/// One change as PROTOCOL.md has it: {"change":"connect","from":"/a/out","to":"/b/in","queue":10}.
/// Errors: it is no object, there is no such change (with the nearest name), a member is missing, unknown
/// or of another kind.
[[nodiscard]] Result<Change> ParseChange(const JsonPart& json);

}  // namespace runnel::internal
