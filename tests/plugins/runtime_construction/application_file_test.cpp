// What right application files become.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/runtime_construction/test_application.h"

namespace runnel::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ApplicationFile, BecomesModulesAndConnectionsThatAreReady) {
  Workshop workshop;
  FrameworkElement* const application = workshop.Build(R"(
    <application name="demo">
      <module name="source" type="test/source"/>
      <module name="sink" type="test/sink"/>
      <connect from="source/value" to="sink/value"/>
    </application>)");

  ASSERT_NE(application, nullptr) << workshop.diagnostics.ToString();
  EXPECT_EQ(application->path(), "/demo");
  EXPECT_EQ(application->life_cycle(), LifeCycle::kReady);
  auto& source = workshop.Get<Source>("/demo/source");
  auto& sink = workshop.Get<Sink>("/demo/sink");
  EXPECT_EQ(sink.life_cycle(), LifeCycle::kReady);
  source.value.Publish(4.5);
  EXPECT_EQ(*sink.value.Read(), 4.5);
}

}  // namespace
}  // namespace runnel::testing
