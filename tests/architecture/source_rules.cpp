#include "tests/architecture/source_rules.h"

#include <algorithm>
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

std::vector<std::string> TooLongFiles(const SourceTree& tree, std::size_t limit) {
  std::vector<std::string> files;
  for (const auto& [file, text] : tree) {
    const std::size_t count = Lines(text).size();
    if (IsCode(file) && count > limit) files.push_back(file + ": " + std::to_string(count) + " lines");
  }
  return files;
}

std::vector<std::string> StrayFiles(const SourceTree& tree) {
  static const std::set<std::string> known = {".clang-format", ".clang-tidy", ".git-blame-ignore-revs", ".gitignore",
                                              ".pre-commit-config.yaml", "CHANGELOG.md", "CMakeLists.txt",
                                              "CMakePresets.json", "LICENSE", "README.md", "check", "demo",
                                              // Of one's own, never of the project.
                                              "CMakeUserPresets.json", "compile_commands.json"};
  std::vector<std::string> stray;
  for (const auto& [file, text] : tree) {
    if (file.find('/') == std::string::npos && !known.contains(file)) stray.push_back(file);
  }
  return stray;
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
  struct Pattern {
    std::vector<std::string> words;  // one of them is in any line that `text` can be found in: that is looked at first
    std::regex text;
    std::string what;
    std::string ending = {};  // of the files that it is for; "": all
  };
  // Written so that they do not match themselves.
  static const std::vector<Pattern> patterns = {
      {{"/wo"
        "rk/",
        "/ro"
        "ot/",
        "/ho"
        "me/"},
       std::regex("(^|[^A-Za-z0-9_.}])/(work|root|home)/"),
       "a path of one machine"},
      {{"TO"
        "DO",
        "FIX"
        "ME",
        "XX"
        "X"},
       std::regex("\\b(TO"
                  "DO|FIX"
                  "ME|XX"
                  "X)\\b"),
       "a mark of something unfinished"},
      {{"@"}, std::regex("@[A-Z]+@"), "a mark of something to be filled in", ".md"}};
  std::vector<std::string> places;
  for (const auto& [file, text] : tree) {
    std::size_t number = 0;
    for (const std::string_view line : Lines(text)) {
      ++number;
      for (const Pattern& pattern : patterns) {
        if (!file.ends_with(pattern.ending)) continue;
        const auto is_there = [&](const std::string& word) { return line.find(word) != std::string_view::npos; };
        if (std::ranges::none_of(pattern.words, is_there)) continue;
        if (!std::regex_search(line.begin(), line.end(), pattern.text)) continue;
        places.push_back(file + ":" + std::to_string(number) + ": " + pattern.what);
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
