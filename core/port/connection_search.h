#pragma once

#include <algorithm>
#include <iterator>

#include "core/port/port.h"

namespace runnel::internal {

/// The connection to `to` among those of one output; from the end, since what has been connected last is asked for
/// most.
template <typename Connections>
auto FindConnection(Connections& outgoing, const Port& to) {
  const auto found = std::find_if(outgoing.rbegin(), outgoing.rend(),
                                  [&](const Connection& each) { return each.to == &to; });
  return found == outgoing.rend() ? outgoing.end() : std::prev(found.base());
}

}  // namespace runnel::internal
