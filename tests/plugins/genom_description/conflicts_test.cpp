#include <algorithm>

#include <gmock/gmock.h>

#include "plugins/genom_description/component_rules.h"
#include "plugins/genom_description/description.h"
#include "tests/plugins/genom_description/verdict.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class GenomConflictsTest : public testing::Test {
 protected:
  void Read(const std::string& text) {
    description_ = genom::ReadDescriptionText(text, "test.gen", {}, diagnostics_);
    ASSERT_TRUE(diagnostics_.ok()) << diagnostics_.ToString();
  }
  // Codels and services that the codel excludes, sorted.
  std::vector<std::string> ExcludedBy(const std::string& name) {
    std::vector<std::string> names;
    for (const genom::Codel* codel : description_->FindComponent("courier")->codels()) {
      if (codel->name != name) continue;
      for (const genom::Codel* each : genom::ConflictingCodels(*codel)) names.push_back(each->name);
      for (const genom::Service* each : genom::ConflictingServices(*codel)) names.push_back(each->name);
    }
    std::ranges::sort(names);
    return names;
  }

  Diagnostics diagnostics_;
  std::unique_ptr<genom::Description> description_;
};

TEST_F(GenomConflictsTest, OfAComponentWithNearlyEverything) {
  Read(FileText("courier.gen"));
  EXPECT_THAT(ExcludedBy("c_init"), ElementsAre("c_clear", "c_idle", "get_busy", "set_limit"));
  EXPECT_THAT(ExcludedBy("c_take"), ElementsAre("c_clear", "c_idle", "get_busy"));
  EXPECT_THAT(ExcludedBy("c_step"), ElementsAre("c_clear", "set_limit"));
  EXPECT_THAT(ExcludedBy("c_done"), ElementsAre("c_idle", "get_busy"));
  for (const char* codel : {"c_quiet", "c_poll", "c_check_limit", "c_check_route", "c_call", "c_quiet2"}) {
    EXPECT_THAT(ExcludedBy(codel), IsEmpty()) << codel;
  }
  EXPECT_DOUBLE_EQ(description_->FindComponent("courier")->clock_rate, 5e-3);
  const auto& services = description_->FindComponent("courier")->services;
  const genom::Service* halt = genom::FindByName(services, "halt");
  EXPECT_TRUE(
      std::ranges::all_of(services, [&](const genom::Service* each) { return genom::Interrupts(*halt, *each); }));
}

TEST_F(GenomConflictsTest, PathsAndDirections) {
  Read(
      "component courier { ids { struct s { long a, b; } x; long y[3]; };"
      " task t { codel<start> whole(in x) yield two; codel<two> part(out x.a) yield three;"
      "          codel<three> first(out y[0]) yield four; codel<four> reader(in y) yield ether; };"
      " task u { codel<start> other_part(out x.b) yield two; codel<two> same_part(in x.a) yield three;"
      "          codel<three> second(out y[1]) yield four; codel<four> also_reads(in y, in x) yield ether; }; };");
  EXPECT_THAT(ExcludedBy("whole"), ElementsAre("other_part"));
  EXPECT_THAT(ExcludedBy("part"), ElementsAre("also_reads", "same_part"));
  EXPECT_THAT(ExcludedBy("first"), ElementsAre("also_reads"));
  EXPECT_THAT(ExcludedBy("reader"), ElementsAre("second"));
}

TEST_F(GenomConflictsTest, PortsAndInterruptedServices) {
  Read(
      "component courier { typedef double d; port in d p; ids { long v; }; task t; task u;"
      " activity a() { task t; codel<start> reads(in p) yield two; codel<two> writes(out v) yield ether; };"
      " activity b() { task u; interrupts a; codel<start> reads_too(in p) yield two; codel<two> writes_too(out v) "
      "yield ether; }; };");
  // a's codels have ended before b's run; b may begin while a runs, seen from b.
  EXPECT_THAT(ExcludedBy("reads"), IsEmpty());
  EXPECT_THAT(ExcludedBy("reads_too"), ElementsAre("reads"));
  EXPECT_THAT(ExcludedBy("writes_too"), ElementsAre("writes"));
}

// The original accepts these, and nothing keeps them apart.
TEST(GenomVerdictsOfConflicts, OfAnAsynchronousCodelAndOneThatInterruptsAll) {
  const auto of = [](const std::string& codel, const std::string& interrupts) {
    return "ids { long v; }; task t { " + codel + " yield pause::start; }; task u; activity a() { task u; interrupts " +
           interrupts + "; codel<start> l(out v) yield ether; };";
  };
  ExpectVerdictsInComponent({
      {kWrong, of("async codel<start> k(out v)", "all")},
      {kWrong, of("async codel<start> k(in v)", "all")},
      {kRight, of("codel<start> k(out v)", "all")},
      {kWrong, of("async codel<start> k(out v)", "a")},
      {kRight, of("async codel<start> k()", "all")},
  });
  EXPECT_THAT(WrongsInComponent(of("async codel<start> k(out v)", "all")), testing::HasSubstr("'k'"));
}

}  // namespace
}  // namespace runnel::test
