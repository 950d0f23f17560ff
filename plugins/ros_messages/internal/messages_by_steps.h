#pragma once

#include <optional>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "plugins/cdr_values/cdr_reader.h"
#include "plugins/cdr_values/cdr_writer.h"
#include "plugins/ros_messages/internal/binding.h"

namespace runnel::internal {

void WriteBySteps(const Step& root, const void* value, Time stamp, CdrWriter& writer);

/// `fresh`: a value as the type makes it, for what is missing at the end. `stamp` is set if the message has one.
Result<void> ReadBySteps(const Step& root, CdrReader& reader, const void* fresh, void* value,
                         std::optional<Time>& stamp);

}  // namespace runnel::internal
