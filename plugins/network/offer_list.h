#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/element_path.h"
#include "plugins/network/network_options.h"

namespace runnel {

/// Renaming back moves what the renaming has moved, and nothing else that has the name by then.
template <typename Offer>
void RenamePorts(std::vector<Offer>& offers, const std::string& from, const std::string& to) {
  const auto is_meant = [&](const Offer& each) { return IsAtOrBelow(each.port, from); };
  const auto renamed = [&](const Offer& each) { return to + each.port.substr(from.size()); };
  const auto comes_back = [&](const Offer& each) {
    return is_meant(each) && !each.ports_before.empty() && each.ports_before.back() == renamed(each);
  };
  const bool is_back = std::ranges::any_of(offers, comes_back);
  for (Offer& each : offers) {
    if (is_back ? !comes_back(each) : !is_meant(each)) continue;
    std::string port = renamed(each);
    is_back ? each.ports_before.pop_back() : each.ports_before.push_back(each.port);
    each.port = std::move(port);
  }
}

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
