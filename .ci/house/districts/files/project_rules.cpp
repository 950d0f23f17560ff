// layers.txt, read.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "tests/architecture/include_rules.h"

namespace runnel::test {

namespace {

// The name as a path from the root of the tree.
std::string WholeName(const std::string& name) {
  static const std::set<std::string> tops = {"core", "plugins", "modules", "apps", "tests", "bench"};
  return tops.contains(name.substr(0, name.find('/'))) ? name : "plugins/" + name;
}

const IncludeRule& RuleCalled(const std::string& name, const std::vector<IncludeRule>& rules) {
  const auto found = std::ranges::find(rules, name, &IncludeRule::files);
  if (found == rules.end()) throw std::invalid_argument("layers.txt: no line above begins with '" + name + "'");
  return *found;
}

// "name+": that, and all that its line says.
void AddKnown(const std::string& word, const std::vector<IncludeRule>& above, std::vector<std::string>& known) {
  if (!word.ends_with('+')) {
    known.push_back(WholeName(word));
    return;
  }
  const IncludeRule& rule = RuleCalled(WholeName(word.substr(0, word.size() - 1)), above);
  known.push_back(rule.files);
  known.insert(known.end(), rule.may_include.begin(), rule.may_include.end());
}

}  // namespace

std::vector<IncludeRule> ReadLayers(std::string_view text) {
  std::vector<IncludeRule> rules;
  for (const std::string_view line : Lines(text)) {
    std::istringstream words{std::string(line)};
    std::string name;
    words >> name;
    if (name == "+") words >> name;
    if (name.empty() || name.starts_with('#')) continue;
    IncludeRule rule{.files = WholeName(name)};
    rule.is_algorithm = rule.files.ends_with("/algorithm");
    for (std::string word; words >> word;) AddKnown(word, rules, rule.may_include);
    rules.push_back(std::move(rule));
  }
  return rules;
}

const std::vector<IncludeRule>& ProjectRules() {
  static const std::vector<IncludeRule> rules = [] {
    std::ifstream stream(RUNNEL_SOURCE_FOLDER "/layers.txt", std::ios::binary);
    return ReadLayers(std::string(std::istreambuf_iterator<char>(stream), {}));
  }();
  return rules;
}

}  // namespace runnel::test
