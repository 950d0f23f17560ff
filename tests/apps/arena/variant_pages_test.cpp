#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/planning/algorithm/bug_variants.h"

namespace runnel {
namespace {

using testing::HasSubstr;

std::string PageOf(const BugVariant& variant) {
  std::ifstream stream(std::filesystem::path(RUNNEL_VARIANTS) / (std::string(variant.name) + ".md"));
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string Row(const std::string& component, std::string_view name) {
  return "| " + component + " | `" + std::string(name) + "`";
}

TEST(VariantPages, NameTheComponentsOfTheTable) {
  for (const BugVariant& variant : kBugVariants) {
    const std::string page = PageOf(variant);
    const std::string name(variant.name);
    EXPECT_THAT(page, HasSubstr("`planning/" + name + "`"));
    EXPECT_THAT(page, HasSubstr("**Bound**"));
    EXPECT_THAT(page, HasSubstr("(pictures/" + name + ".svg)"));
    const BugComponents components = Assemble(variant.composition);
    EXPECT_THAT(page, HasSubstr(Row("motion to goal", components.motion->name()))) << name;
    EXPECT_THAT(page, HasSubstr(Row("direction", components.direction->name()))) << name;
    EXPECT_THAT(page, HasSubstr(Row("leave condition", components.leave->name()))) << name;
    EXPECT_THAT(page, HasSubstr(Row("revisit", components.revisit->name()))) << name;
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(RUNNEL_VARIANTS) / "pictures" / (name + ".svg"))) << name;
  }
}

}  // namespace
}  // namespace runnel
