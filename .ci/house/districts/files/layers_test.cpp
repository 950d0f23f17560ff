// What layers.txt says, read, and what is made of it.

#include <stdexcept>

#include <gmock/gmock.h>

#include "tests/architecture/include_rules.h"
#include "tests/architecture/plan_picture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kLayers =
    "# a comment\n"
    "+ core/base\n"
    "+ core/port              core\n"
    "\n"
    "+ values/json            core\n"
    "  execution/timing       core/base values/json/writer.h\n"
    "  execution/scheduling   core execution\n"
    "  tracing/application_   execution/scheduling+ values\n";

TEST(LayersTest, NamesArePathsFromTheRoot) {
  const std::vector<IncludeRule> rules = ReadLayers(kLayers);
  ASSERT_EQ(rules.size(), 6u);
  EXPECT_EQ(rules[2].files, "plugins/values/json");
  EXPECT_THAT(rules[2].may_include, ElementsAre("core"));
  EXPECT_THAT(rules[3].may_include, ElementsAre("core/base", "plugins/values/json/writer.h"));
  EXPECT_THAT(rules[5].may_include,
              ElementsAre("plugins/execution/scheduling", "core", "plugins/execution", "plugins/values"));
}

TEST(LayersTest, ANameStandsForWhatIsAboveIt) {
  SourceTree tree = {{"core/base/a.h", ""},
                     {"core/port/b.h", "#include \"core/base/a.h\"\n"},
                     {"plugins/execution/timing/c.h", ""},
                     {"plugins/execution/scheduling/d.h", "#include \"plugins/execution/timing/c.h\"\n"}};
  EXPECT_THAT(IncludeOffences(tree, ReadLayers(kLayers)), IsEmpty());
  tree["plugins/execution/timing/c.h"] = "#include \"plugins/execution/scheduling/d.h\"\n";
  EXPECT_THAT(IncludeOffences(tree, ReadLayers(kLayers)), ElementsAre(HasSubstr("plugins/execution/timing may not know")));
}

TEST(LayersTest, FilesMayBeginWithMoreThanTheirFolderMayKnow) {
  const std::string wanted = "#include \"plugins/values/json/writer.h\"\n";
  const SourceTree tree = {{"plugins/values/json/writer.h", ""},
                           {"plugins/tracing/application_plugin.cpp", wanted},
                           {"plugins/execution/scheduling/d.h", wanted}};
  EXPECT_THAT(IncludeOffences(tree, ReadLayers(kLayers)), ElementsAre(HasSubstr("plugins/execution/scheduling/d.h:1")));
}

TEST(LayersTest, WhatStandsBelowCannotBeNamedWithAPlus) {
  EXPECT_THROW(static_cast<void>(ReadLayers("values/json  execution/timing+\n")), std::invalid_argument);
}

TEST(LayersTest, ThePictureHasFloorsAndWhatEachStandsOn) {
  EXPECT_EQ(PlanPicture(ReadLayers(kLayers)),
            "3 │ tracing\n"
            "2 │ execution\n"
            "1 │ values\n"
            "0 │ core\n"
            "\n"
            "tracing      on execution\n"
            "execution    on values\n"
            "values       on core\n");
}

}  // namespace
}  // namespace runnel::test
