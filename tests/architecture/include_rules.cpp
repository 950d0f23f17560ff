#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <functional>
#include <map>
#include <regex>

namespace runnel::test {

namespace {

// One #include line.
struct Include {
  std::string file;
  std::size_t line;
  std::string target;
  bool is_quoted;
};

std::vector<Include> IncludesOf(const std::string& file, const std::string& text) {
  static const std::regex pattern(R"(^\s*#\s*include\s*(["<])([^">]+)[">])");
  std::vector<Include> includes;
  std::size_t number = 0;
  for (const std::string_view line : Lines(text)) {
    ++number;
    std::cmatch match;
    if (line.find('#') == std::string_view::npos) continue;
    if (!std::regex_search(line.data(), line.data() + line.size(), match, pattern)) continue;
    includes.push_back({file, number, match[2], match[1] == "\""});
  }
  return includes;
}

std::vector<Include> AllIncludes(const SourceTree& tree) {
  std::vector<Include> all;
  for (const auto& [file, text] : tree) {
    if (!IsCode(file)) continue;
    std::ranges::move(IncludesOf(file, text), std::back_inserter(all));
  }
  return all;
}

const IncludeRule* RuleOf(std::string_view file, const std::vector<IncludeRule>& rules) {
  const auto found = std::ranges::find_if(rules, [&](const IncludeRule& rule) {
    const bool is_prefix = rule.files.ends_with('_');
    return is_prefix ? file.starts_with(rule.files) : IsAtOrBelow(file, rule.files);
  });
  return found == rules.end() ? nullptr : &*found;
}

bool IsBullet(const std::string& header) {
  static const std::regex bullet("bt[A-Za-z]+\\.h|bullet/.*");
  return std::regex_match(header, bullet);
}

bool MayUseBullet(std::string_view file) {
  return IsAtOrBelow(file, "modules/simulation") || IsAtOrBelow(file, "tests/modules/simulation");
}

// fmt is the standard's <format>, which this compiler does not have yet.
bool IsAllowedInAlgorithms(const std::string& header) {
  static const std::regex standard("[a-z0-9_]+");
  return std::regex_match(header, standard) || header.starts_with("Eigen/") || header == "fmt/format.h" ||
         IsBullet(header);
}

// What is wrong with an include in angle brackets; "" if nothing is.
std::string OffenceOfForeign(const Include& include, const IncludeRule& rule) {
  if (IsBullet(include.target) && !MayUseBullet(include.file)) {
    return "Bullet is for modules/simulation only: <" + include.target + ">";
  }
  if (!rule.is_algorithm || IsAllowedInAlgorithms(include.target)) return "";
  return "an algorithm may use the standard library, Eigen and fmt, not <" + include.target + ">";
}

// The test library's headers may stand in quotation marks too.
bool IsGoogleTest(const std::string& target) { return target.starts_with("gtest/") || target.starts_with("gmock/"); }

// The folder that an internal header belongs to, "" for others.
std::string OwnerOfInternal(const std::string& target) {
  const auto at = target.find("/internal/");
  return at == std::string::npos ? "" : target.substr(0, at);
}

// What is wrong with an include by a file under `rule`; "" if nothing is.
std::string Offence(const Include& include, const IncludeRule& rule, const SourceTree& tree,
                    const std::vector<IncludeRule>& rules) {
  if (!include.is_quoted) return OffenceOfForeign(include, rule);
  if (IsGoogleTest(include.target) && include.file.starts_with("tests/")) return "";
  if (!tree.contains(include.target)) {
    return "\"" + include.target + "\" is no file, seen from the root of the tree";
  }
  const std::string owner = OwnerOfInternal(include.target);
  if (!owner.empty() && !IsAtOrBelow(include.file, owner) && !include.file.starts_with("tests/")) {
    return "\"" + include.target + "\" is internal to " + owner;
  }
  const IncludeRule* const other = RuleOf(include.target, rules);
  if (other == &rule) return "";
  const bool allowed = std::ranges::any_of(
      rule.may_include, [&](const std::string& folder) { return IsAtOrBelow(include.target, folder); });
  return allowed ? "" : rule.name + " may not know \"" + include.target + "\"";
}

}  // namespace

std::vector<std::string> IncludeOffences(const SourceTree& tree, const std::vector<IncludeRule>& rules) {
  std::vector<std::string> offences;
  for (const auto& [file, text] : tree) {
    if (IsCode(file) && RuleOf(file, rules) == nullptr) {
      offences.push_back(file + ":1: falls under no rule; say what it may include");
    }
  }
  for (const Include& include : AllIncludes(tree)) {
    const IncludeRule* const rule = RuleOf(include.file, rules);
    if (rule == nullptr) continue;
    const std::string offence = Offence(include, *rule, tree, rules);
    if (offence.empty()) continue;
    offences.push_back(include.file + ":" + std::to_string(include.line) + ": " + offence);
  }
  return offences;
}

std::vector<std::string> Circles(const SourceTree& tree, const std::vector<IncludeRule>& rules) {
  std::map<std::string, std::set<std::string>> knows;
  for (const Include& include : AllIncludes(tree)) {
    if (!include.is_quoted) continue;
    const IncludeRule* const from = RuleOf(include.file, rules);
    const IncludeRule* const to = RuleOf(include.target, rules);
    if (from != nullptr && to != nullptr && from != to) knows[from->name].insert(to->name);
  }
  std::vector<std::string> circles;
  std::set<std::string> finished;
  std::vector<std::string> way;
  const std::function<void(const std::string&)> visit = [&](const std::string& part) {
    const auto met = std::ranges::find(way, part);
    if (met != way.end()) {
      std::string circle;
      for (auto each = met; each != way.end(); ++each) circle += *each + " > ";
      circles.push_back(circle + part);
      return;
    }
    if (finished.contains(part)) return;
    way.push_back(part);
    for (const std::string& next : knows[part]) visit(next);
    way.pop_back();
    finished.insert(part);
  };
  std::vector<std::string> parts;
  for (const auto& [part, others] : knows) parts.push_back(part);
  for (const std::string& part : parts) visit(part);
  return circles;
}

}  // namespace runnel::test
