// What right application files become.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/element/file_notes.h"
#include "core/port/proxy_port.h"
#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

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

TEST(ApplicationFile, MayConnectBeforeItNamesTheModules) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(
    <application name="demo">
      <connect from="source/output/value" to="/demo/sink/input/value sink/second"/>
      <module name="sink" type="test/sink"/>
      <module name="source" type="test/source"/>
    </application>)"))
      << workshop.diagnostics.ToString();
  workshop.Get<Source>("/demo/source").value.Publish(2.0);
  EXPECT_EQ(*workshop.Get<Sink>("/demo/sink").value.Read(), 2.0);
  EXPECT_EQ(*workshop.Get<Sink>("/demo/sink").second.Read(), 2.0);
}

TEST(ApplicationFile, TellsAnInputAndAnOutputOfOneNameApartByTheEndOfTheConnection) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(
    <application name="demo">
      <module name="source" type="test/source"/>
      <module name="filter" type="test/filter"/>
      <module name="sink" type="test/sink"/>
      <connect from="source/value" to="filter/value"/>
      <connect from="filter/value" to="sink/value"/>
    </application>)"))
      << workshop.diagnostics.ToString();
  auto& filter = workshop.Get<Filter>("/demo/filter");
  EXPECT_EQ(filter.value_in.Sources().size(), 1u);
  EXPECT_EQ(filter.value_out.Sinks().size(), 1u);
}

TEST(ApplicationFile, ResolvesPathsFromTheEnclosingGroup) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(
    <application name="demo">
      <module name="source" type="test/source"/>
      <group name="inner">
        <module name="sink" type="test/sink"/>
        <connect from="../source/value" to="sink/value"/>
      </group>
    </application>)"))
      << workshop.diagnostics.ToString();
  EXPECT_EQ(workshop.Get<Sink>("/demo/inner/sink").value.Sources().size(), 1u);
}

TEST(ApplicationFile, GivesConnectionsTheirQueues) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(
    <application name="demo">
      <module name="source" type="test/source"/>
      <module name="sink" type="test/sink"/>
      <connect from="source/value" to="sink/value" queue="2" on_full="drop_newest"/>
      <connect from="source/value" to="sink/second" queue="1" on_full="refuse"/>
    </application>)"))
      << workshop.diagnostics.ToString();
  auto& source = workshop.Get<Source>("/demo/source");
  auto& sink = workshop.Get<Sink>("/demo/sink");
  ASSERT_EQ(source.value.outgoing().size(), 2u);
  EXPECT_EQ(source.value.outgoing()[0].options.on_full, OnFull::kDropNewest);
  EXPECT_EQ(source.value.outgoing()[1].options.on_full, OnFull::kRefuse);
  EXPECT_EQ(source.value.Publish(1.0), PublishStatus::kPublished);
  EXPECT_EQ(source.value.Publish(2.0), PublishStatus::kRefused);
  EXPECT_EQ(source.value.Publish(3.0), PublishStatus::kRefused);
  EXPECT_EQ(sink.value.dropped(), 1u);
  EXPECT_EQ(*sink.value.Take(), 1.0);
  EXPECT_EQ(*sink.value.Take(), 2.0);
  EXPECT_EQ(*sink.second.Take(), 1.0);
}

TEST(ApplicationFile, DropsTheOldestOfAFullQueueUnlessToldOtherwise) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(
    <application name="demo">
      <module name="source" type="test/source"/>
      <module name="sink" type="test/sink"/>
      <connect from="source/value" to="sink/value" queue="1"/>
    </application>)"))
      << workshop.diagnostics.ToString();
  auto& source = workshop.Get<Source>("/demo/source");
  source.value.Publish(1.0);
  source.value.Publish(2.0);
  EXPECT_EQ(*workshop.Get<Sink>("/demo/sink").value.Take(), 2.0);
}

TEST(ApplicationFile, PassesDataThroughTheInterfacesOfNestedGroups) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(
    <application name="demo">
      <group name="outer">
        <port name="reading" direction="output" description="what it reads"/>
        <group name="inner">
          <port name="reading" direction="output"/>
          <module name="source" type="test/source"/>
          <connect from="source/value" to="reading"/>
        </group>
        <connect from="inner/reading" to="reading"/>
      </group>
      <group name="sinks">
        <port name="wanted" direction="input" type="double"/>
        <module name="sink" type="test/sink"/>
        <connect from="wanted" to="sink/value"/>
      </group>
      <connect from="outer/reading" to="sinks/wanted"/>
    </application>)"))
      << workshop.diagnostics.ToString();
  auto& reading = workshop.Get<ProxyPort>("/demo/outer/reading");
  EXPECT_EQ(reading.direction(), Port::Direction::kOutput);
  EXPECT_EQ(reading.description(), "what it reads");
  EXPECT_EQ(&reading.type(), &TypeOf<double>());
  EXPECT_EQ(workshop.Get<ProxyPort>("/demo/sinks/wanted").direction(), Port::Direction::kInput);
  workshop.Get<Source>("/demo/outer/inner/source").value.Publish(7.0);
  EXPECT_EQ(*workshop.Get<Sink>("/demo/sinks/sink").value.Read(), 7.0);
}

TEST(ApplicationFile, TakesTheTypeOfAnInputInterfaceFromWhatItFeeds) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(
    <application name="demo">
      <group name="sinks">
        <port name="wanted" direction="input"/>
        <module name="sink" type="test/sink"/>
        <connect from="wanted" to="sink/label"/>
      </group>
    </application>)"))
      << workshop.diagnostics.ToString();
  EXPECT_EQ(&workshop.Get<ProxyPort>("/demo/sinks/wanted").type(), &TypeOf<std::string>());
}

TEST(ApplicationFile, TakesTheTypeOfAnInterfaceFromOutsideIfNothingInsideTellsIt) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(
    <application name="demo">
      <module name="source" type="test/source"/>
      <group name="empty">
        <port name="wanted" direction="input"/>
      </group>
      <connect from="source/label" to="empty/wanted"/>
    </application>)"))
      << workshop.diagnostics.ToString();
  EXPECT_EQ(&workshop.Get<ProxyPort>("/demo/empty/wanted").type(), &TypeOf<std::string>());
}

TEST(ApplicationFile, LeavesItsPlaceWithEveryElement) {
  Workshop workshop;
  ASSERT_TRUE(workshop.Build(R"(<application name="demo">
  <group name="inner">
    <module name="sink" type="test/sink"/>
  </group>
</application>)"));
  const auto place = FindSourcePlace(workshop.Get<Sink>("/demo/inner/sink").value);
  EXPECT_EQ(place, (SourcePosition{"app.xml", 3, 5}));
}

TEST(ApplicationFile, CanBeBuiltTwiceUnderTwoNames) {
  Workshop workshop;
  EXPECT_TRUE(workshop.Build(R"(<application name="one"/>)"));
  EXPECT_TRUE(workshop.Build(R"(<application name="two"/>)"));
  EXPECT_EQ(workshop.runtime.root().children().size(), 2u);
}

TEST(ApplicationFile, CanBeLookedAtBeforeItIsMadeReady) {
  Workshop workshop;
  const auto document = XmlDocument::Parse("<application name='demo'><group name='g'/></application>", "app.xml");
  const BuildOutcome outcome =
      BuildApplication(*document, "/apps", {workshop.runtime, workshop.plugins, workshop.tags, workshop.configuration},
                       BuildMode::kConstruct);
  ASSERT_TRUE(outcome.application);
  const FrameworkElement& group = *outcome.application->FindChild("g");
  EXPECT_EQ(group.life_cycle(), LifeCycle::kConstructed);
  EXPECT_TRUE(MakeApplicationReady(*outcome.application));
  EXPECT_EQ(group.life_cycle(), LifeCycle::kReady);
}

TEST(ApplicationFile, IsOnlyLookedAtInACheck) {
  Workshop workshop;
  // A module that cannot become ready, since its file is not there, is right nevertheless.
  EXPECT_EQ(workshop.Build(R"(
    <application name="demo"><module name="x" type="test/unready"/></application>)",
                           BuildMode::kCheck),
            nullptr);
  EXPECT_EQ(workshop.diagnostics.ToString(), "");
  EXPECT_TRUE(workshop.runtime.root().children().empty());
}

}  // namespace
}  // namespace runnel::testing
