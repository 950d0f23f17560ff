#include "core/base/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace runnel {

namespace {

std::string Lowered(std::string_view text) {
  std::string lowered(text);
  for (char& character : lowered) {
    character = static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  }
  return lowered;
}

constexpr std::size_t kMostNamesListed = 12;

}  // namespace

int EditDistance(std::string_view a, std::string_view b) {
  // Three rows of the usual table: swaps of neighbours look back two rows.
  std::vector<int> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({replace, previous[j] + 1, current[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before[j - 2] + 1);
      }
    }
    before.swap(previous);
    previous.swap(current);
  }
  return previous[b.size()];
}

std::string NearestName(std::string_view name, std::span<const std::string> candidates) {
  const std::string wanted = Lowered(name);
  std::string nearest;
  int least = static_cast<int>(std::max<std::size_t>(name.size() / 3, 1)) + 1;
  for (const std::string& candidate : candidates) {
    const int distance = EditDistance(wanted, Lowered(candidate));
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string NearestNameHint(std::string_view name, std::span<const std::string> candidates) {
  if (candidates.empty()) return "there is none";
  const std::string nearest = NearestName(name, candidates);
  if (!nearest.empty()) return "did you mean '" + nearest + "'?";
  std::string list = "there is ";
  for (std::size_t i = 0; i < std::min(candidates.size(), kMostNamesListed); ++i) {
    if (i > 0) list += ", ";
    list += "'" + candidates[i] + "'";
  }
  if (candidates.size() > kMostNamesListed) {
    list += " and " + std::to_string(candidates.size() - kMostNamesListed) + " more";
  }
  return list;
}

}  // namespace runnel
