#include "tests/architecture/source_rules.h"

#include <map>
#include <regex>
#include <set>

namespace runnel::test {

std::vector<std::string> TooLargeLibraries(const SourceTree& tree, std::size_t limit) {
  std::map<std::string, std::size_t> lines;
  for (const auto& [file, text] : tree) {
    if (IsCode(file) && !LibraryOf(file).empty()) lines[LibraryOf(file)] += Lines(text).size();
  }
  std::vector<std::string> large;
  for (const auto& [library, count] : lines) {
    // The tests of all core libraries together are no library.
    if (library.starts_with("tests/") || library.starts_with("bench/")) continue;
    if (count >= limit) large.push_back(library + ": " + std::to_string(count) + " lines");
  }
  return large;
}

std::vector<std::string> LibrariesWithoutReadme(const SourceTree& tree) {
  std::set<std::string> libraries;
  for (const auto& [file, text] : tree) {
    const bool is_product = !file.starts_with("tests/") && !file.starts_with("bench/");
    if (IsCode(file) && is_product && !LibraryOf(file).empty()) libraries.insert(LibraryOf(file));
  }
  std::vector<std::string> without;
  for (const std::string& library : libraries) {
    if (!tree.contains(library + "/README.md")) without.push_back(library);
  }
  return without;
}

std::vector<std::string> ForbiddenText(const SourceTree& tree) {
  // Written so that they do not match themselves.
  static const std::vector<std::pair<std::regex, std::string>> patterns = {
      {std::regex("(^|[^A-Za-z0-9_.}])/(work|root|home)/"), "a path of one machine"},
      {std::regex("\\b(TO"
                  "DO|FIX"
                  "ME|XX"
                  "X)\\b"),
       "a mark of something unfinished"}};
  std::vector<std::string> places;
  for (const auto& [file, text] : tree) {
    std::size_t number = 0;
    for (const std::string_view line : Lines(text)) {
      ++number;
      for (const auto& [pattern, what] : patterns) {
        if (!std::regex_search(line.begin(), line.end(), pattern)) continue;
        places.push_back(file + ":" + std::to_string(number) + ": " + what);
      }
    }
  }
  return places;
}

std::vector<std::string> HeadersWithoutGuard(const SourceTree& tree) {
  std::vector<std::string> headers;
  for (const auto& [file, text] : tree) {
    if (file.ends_with(".h") && !text.starts_with("#pragma once\n")) headers.push_back(file);
  }
  return headers;
}

}  // namespace runnel::test
