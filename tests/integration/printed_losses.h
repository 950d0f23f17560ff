#pragma once

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/integration/values_on_the_way.h"

namespace runnel::test {

/// Of the table of losses.
struct Row {
  Demo demo;
  OnTheWay value;
  [[nodiscard]] std::string name() const { return demo.file.substr(0, demo.file.find('.')) + value.output; }
};
inline const std::vector<Row>& Rows() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> all;
    for (const Demo& demo : Demos()) {
      for (const OnTheWay& value : demo.values) all.push_back({demo, value});
    }
    return all;
  }();
  return rows;
}

/// The manual's table: the cells of each row, by its name. That of the head is "value".
inline std::map<std::string, std::vector<std::string>> Printed() {
  std::map<std::string, std::vector<std::string>> rows;
  std::ifstream manual(RUNNEL_XML "/../apps/documentation/pages/concepts/losses.md");
  for (std::string line; std::getline(manual, line);) {
    std::vector<std::string> cells;
    for (std::size_t at = 2, end = 0; line.starts_with("| ") && (end = line.find(" |", at)) != std::string::npos;
         at = end + 3)
      cells.push_back(line.substr(at, end - at));
    if (cells.empty()) continue;
    const std::string name = cells.front();
    cells.erase(cells.begin());
    rows.emplace(name, std::move(cells));
  }
  return rows;
}

/// Letters and digits only.
inline std::string AsTestName(std::string name) {
  std::ranges::replace_if(
      name, [](char each) { return std::isalnum(each) == 0; }, '_');
  return name;
}

}  // namespace runnel::test
