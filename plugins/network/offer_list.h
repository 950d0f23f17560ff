#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "plugins/network/network_options.h"

namespace runnel {

/// What an application called `network` offers, as it comes and goes.
struct OfferList {
  const std::string& network;
  std::vector<OfferOptions> offers;

  /// With the port, too, as `wanted` says. Errors: it is offered so already.
  Result<void> Add(const std::string& path, OfferOptions wanted);
  /// Without the port, or, with a topic, without that one of it. Errors: it is not offered.
  Result<void> Remove(const std::string& path, const std::string& topic);
  /// What is at or below `from` is at or below `to` now, also what a pattern names from the root: "!/laser/scan".
  void Rename(const std::string& from, const std::string& to);
  /// Of two that offer one port as one topic, as when it has got the name of one that has gone, only the first, which counts.
  void DropSecond();
};

}  // namespace runnel
