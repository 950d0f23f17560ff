#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace runnel {

/// The number of insertions, deletions, replacements and swaps of neighbours that turn `a` into
/// `b`. O(|a| |b|).
[[nodiscard]] int EditDistance(std::string_view a, std::string_view b);

/// The candidate that a user who typed `name` most likely meant, or "" if none is near: more than a
/// third of the characters would have to change. Of equals, the first wins. Case does not count much.
[[nodiscard]] std::string NearestName(std::string_view name, std::span<const std::string> candidates);

/// The names of things, as `name_of` (a function or a member) gives them.
template <typename Things, typename NameOf>
[[nodiscard]] std::vector<std::string> NamesOf(const Things& things, NameOf name_of) {
  std::vector<std::string> names;
  for (const auto& each : things) names.emplace_back(std::invoke(name_of, each));
  return names;
}

/// A hint for an error message: "did you mean 'scan'?", or "there is 'a', 'b', 'c'" if no candidate
/// is near, or "there is none" without candidates.
[[nodiscard]] std::string NearestNameHint(std::string_view name, std::span<const std::string> candidates);

}  // namespace runnel
