#include "tests/architecture/plan_picture.h"

#include <algorithm>
#include <map>
#include <set>

namespace runnel::test {

namespace {

using Names = std::set<std::string>;

// The districts, bottom to top.
std::vector<std::string> Districts(const std::vector<IncludeRule>& rules) {
  std::vector<std::string> districts;
  for (const IncludeRule& rule : rules) {
    const std::string district = DistrictOf(rule.files);
    if (!district.empty() && std::ranges::find(districts, district) == districts.end()) districts.push_back(district);
  }
  return districts;
}

// What each stands on, directly or not.
std::map<std::string, Names> Below(const std::vector<IncludeRule>& rules) {
  std::map<std::string, Names> below;
  for (const IncludeRule& rule : rules) {
    const std::string district = DistrictOf(rule.files);
    if (district.empty()) continue;
    for (const std::string& name : rule.may_include) {
      const std::string known = DistrictOf(name);
      if (known.empty() || known == district) continue;
      below[district].insert(known);
      below[district].insert(below[known].begin(), below[known].end());
    }
  }
  return below;
}

std::string Joined(const std::vector<std::string>& names, const std::string& mark) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : mark) + name;
  return text;
}

}  // namespace

std::string DistrictOf(std::string_view file) {
  constexpr std::string_view kTop = "plugins/";
  if (!file.starts_with(kTop)) return "";
  file.remove_prefix(kTop.size());
  return std::string(file.substr(0, file.find('/')));
}

std::string PlanPicture(const std::vector<IncludeRule>& rules) {
  const std::vector<std::string> districts = Districts(rules);
  std::map<std::string, Names> below = Below(rules);
  std::map<std::string, std::size_t> floors;
  std::vector<std::vector<std::string>> house;
  std::string arrows;
  for (const std::string& district : districts) {
    std::size_t floor = 1;
    std::vector<std::string> direct;
    for (const std::string& other : districts) {
      if (!below[district].contains(other)) continue;
      floor = std::max(floor, floors[other] + 1);
      const bool is_said = std::ranges::any_of(
          below[district], [&](const std::string& between) { return below[between].contains(other); });
      if (!is_said) direct.push_back(other);
    }
    floors[district] = floor;
    if (house.size() < floor) house.resize(floor);
    house[floor - 1].push_back(district);
    const std::string padding(district.size() < 12 ? 12 - district.size() : 0, ' ');
    arrows = district + padding + " on " + (direct.empty() ? "core" : Joined(direct, ", ")) + "\n" + arrows;
  }
  std::string picture;
  for (std::size_t floor = house.size(); floor > 0; --floor) {
    picture += std::to_string(floor) + " │ " + Joined(house[floor - 1], " │ ") + "\n";
  }
  return picture + "0 │ core\n\n" + arrows;
}

}  // namespace runnel::test
