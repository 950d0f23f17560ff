#include "tests/plugins/genom_description/verdict.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "plugins/genom_description/description.h"

namespace runnel::test {

std::string Wrongs(const std::string& text) {
  Diagnostics diagnostics;
  (void)genom::ReadDescriptionText(text, "test.gen", {}, diagnostics);
  return diagnostics.ok() ? "" : diagnostics.ToString();
}

std::string WrongsInComponent(const std::string& items) { return Wrongs("component c {\n" + items + "\n};"); }

void ExpectVerdicts(const std::vector<Case>& cases) {
  for (const Case& each : cases) {
    const std::string wrongs = Wrongs(each.text);
    EXPECT_EQ(wrongs.empty(), each.is_right) << each.text << "\n" << wrongs;
  }
}

void ExpectVerdictsInComponent(const std::vector<Case>& cases) {
  for (const Case& each : cases) {
    const std::string wrongs = WrongsInComponent(each.text);
    EXPECT_EQ(wrongs.empty(), each.is_right) << each.text << "\n" << wrongs;
  }
}

std::string FileText(const std::string& name) {
  std::ifstream stream(std::filesystem::path(RUNNEL_GENOM_FOLDER) / name);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace runnel::test
