#pragma once

#include "core/port/port.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/path_use.h"

namespace runnel {

/// Which end of a connection a path names. Decides between an input and an output of one name.
enum class ConnectionEnd { kFrom, kTo };

/// The port that a path names. "laser/scan" is short for "laser/output/scan": the groups between a
/// module and its ports may be left out. nullptr after reporting what is not there.
[[nodiscard]] Port* SearchPort(const PathUse& use, ConnectionEnd end, BuildContext& context);

/// The same, without reporting.
[[nodiscard]] Port* FindPort(const PathUse& use, ConnectionEnd end);

}  // namespace runnel
