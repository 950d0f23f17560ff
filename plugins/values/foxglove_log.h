#pragma once

#include "plugins/values/foxglove_channel.h"

namespace runnel {

/// What modules say, in Foxglove's schema for it, foxglove.Log, under the topic "/log". Its values are
/// LogMessages; the time that is given with one counts.
[[nodiscard]] FoxgloveChannel LogChannel();

}  // namespace runnel
