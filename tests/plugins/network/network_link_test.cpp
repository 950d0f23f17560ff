// Applications in a network of this process: what is offered and taken, without an engine that needs a network.

#include <random>

#include <gmock/gmock.h>

#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/testing/guards.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class NetworkLinkTest : public testing::Test {
 protected:
  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
};

TEST_F(NetworkLinkTest, AValueGoesFromOneToTheOther) {
  Member a(*engine_, "a");
  Member b(*engine_, "b");
  a.Offer({.patterns = {"module/*"}});
  b.Take({.topic = "/a/module/place"}, b.module.goal);
  a.Begin();
  b.Begin();
  WaitUntil("it is read", [&] { return IsConnected(a.module.place); });
  a.module.place.Publish({1, 2});
  WaitUntil("it has come", [&] { return b.module.goal.Read().has_value(); });
  EXPECT_EQ(b.module.goal.Get().y, 2);
  EXPECT_THAT(a.Text(), HasSubstr("offers /application/module/output/place as /a/module/place"));
  EXPECT_THAT(b.Text(), HasSubstr("written by a (reliable, newest 1)"));
}

TEST_F(NetworkLinkTest, APortThatNobodyReadsKnowsNothingOfTheNetwork) {
  Member a(*engine_, "a");
  a.Offer({.patterns = {"module/*"}});
  a.Begin();
  EXPECT_FALSE(IsConnected(a.module.place));
  {
    Member b(*engine_, "b");
    b.Take({.topic = "/a/module/place"}, b.module.goal);
    b.Begin();
    WaitUntil("it is read", [&] { return IsConnected(a.module.place); });
    EXPECT_FALSE(IsConnected(a.module.row));
  }
  WaitUntil("it is read no more", [&] { return !IsConnected(a.module.place); });
}

TEST_F(NetworkLinkTest, PublishingWhatIsReadElsewhereAllocatesNothing) {
  Member a(*engine_, "a");
  Member b(*engine_, "b");
  a.Offer({.patterns = {"module/*"}});
  b.Take({.topic = "/a/module/place"}, b.module.goal);
  a.Begin();
  b.Begin();
  WaitUntil("it is read", [&] { return IsConnected(a.module.place); });
  a.module.place.Publish({0, 0});
  const AllocationGuard guard;
  for (int i = 1; i <= 100; ++i) a.module.place.Publish({1.0 * i, 0});
  EXPECT_EQ(guard.allocations(), 0u);
  WaitUntil("the newest has come", [&] { return b.module.goal.Get().x == 100; });
}

TEST_F(NetworkLinkTest, OfAQueueEachValueComesInItsOrder) {
  Member a(*engine_, "a");
  Member b(*engine_, "b");
  a.Offer({.port = "/application/module/row", .topic = "/rows", .quality = ValueQuality::kEach});
  b.Take({.topic = "/rows"}, b.module.wanted);
  a.Begin();
  b.Begin();
  ProbePort all(b.runtime.root(), "all", TypeOf<Row>());
  ASSERT_TRUE(Port::Connect(*b.network->takes().front().output, all));
  WaitUntil("it is read", [&] { return IsConnected(a.module.row); });
  for (int i = 0; i < 100; ++i) a.module.row.Publish({{1.0 * i}});
  std::vector<double> values;
  WaitUntil("all have come", [&] {
    while (
        all.Take([&](const void* value, ValueTimes) { values.push_back(static_cast<const Row*>(value)->values[0]); })) {
    }
    return values.size() >= 100;
  });
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(values[i], static_cast<double>(i));
}

TEST_F(NetworkLinkTest, WhoComesLateGetsWhatIsLatchedAndWhoComesBackGoesOn) {
  Member a(*engine_, "a");
  a.Offer({.port = "/application/module/place", .topic = "/map", .quality = ValueQuality::kLatched});
  a.Begin();
  a.module.place.Publish({7, 0});
  for (int i = 0; i < 2; ++i) {
    Member b(*engine_, "b");
    b.Take({.topic = "/map"}, b.module.goal);
    b.Begin();
    WaitUntil("it has come", [&] { return b.module.goal.Read().has_value(); });
    EXPECT_EQ(b.module.goal.Get().x, 7);
  }
}

TEST_F(NetworkLinkTest, ValuesAreAsOldAsTheirWriterSaysWhereThatIsAskedFor) {
  Member a(*engine_, "a");
  Member b(*engine_, "b");
  a.Offer({.patterns = {"module/*"}});
  b.Take({.topic = "/a/module/place", .keeps_stamps = true}, b.module.goal);
  a.Begin();
  b.Begin();
  WaitUntil("it is read", [&] { return IsConnected(a.module.place); });
  const Time measured = a.runtime.clock().Now() - std::chrono::seconds(5);
  a.module.place.Publish({1, 2}, measured);
  WaitUntil("it has come", [&] { return b.module.goal.Read().has_value(); });
  // The clocks of one machine differ by what the clock of the day is corrected meanwhile.
  EXPECT_LT(std::chrono::abs(b.module.goal.Read().timestamp() - measured), std::chrono::seconds(1));
}

TEST_F(NetworkLinkTest, ValuesFromSimulatedTimeAreAsOldAsTheirArrival) {
  Member a(*engine_, "a");
  Member b(*engine_, "b");
  a.Offer({.patterns = {"module/*"}});
  b.Take({.topic = "/a/module/place", .keeps_stamps = true}, b.module.goal);
  a.Begin(true);
  b.Begin();
  WaitUntil("it is read", [&] { return IsConnected(a.module.place); });
  const Time before = b.runtime.clock().Now();
  a.module.place.Publish({1, 2}, Time(std::chrono::seconds(3)));
  WaitUntil("it has come", [&] { return b.module.goal.Read().has_value(); });
  EXPECT_GE(b.module.goal.Read().timestamp(), before);
}

TEST_F(NetworkLinkTest, AnotherTypeUnderTheSameNameIsToldWithBothSidesWords) {
  Member b(*engine_, "b");
  b.Take({.topic = "/a/place"}, b.module.goal);
  b.Begin();
  struct Nobody final : WireDiscovery {
    void OnMember(const WireMember&) override {}
    void OnMemberGone(const WireId&) override {}
    void OnEndpoint(const WireEndpoint&) override {}
    void OnEndpointGone(const WireId&) override {}
  } nobody;
  const auto other = Must(engine_->Join({.name = "other"}, nobody));
  const auto of_other_version =
      Must(other->MakeWriter({.topic = "rt/a/place",
                              .type = Must(ValueForm::Make(TypeOf<Place>(), "", ""))->codec->dds_type(),
                              .user_data = "runnel_type={x:double[m],y:float[m]};"},
                             {}));
  b.WaitFor("y:float[m]");
  EXPECT_THAT(b.said(),
              HasSubstr("/a/place of other does not fit: they are of two versions: the writer's has 'y:float[m]' "
                        "where the reader's has 'y:double[m]'"));
  EXPECT_THAT(b.Text(), HasSubstr("NOT MATCHED, they are of two versions"));
  ASSERT_TRUE(of_other_version->Write(std::make_shared<Octets>(Octets(20)), 1));
  WaitUntilQuiet(*engine_);
  EXPECT_THAT(b.Text(), HasSubstr(", 0 came\n"));
  EXPECT_FALSE(b.module.goal.Read().has_value());
  const auto of_other_type =
      Must(other->MakeWriter({.topic = "rt/a/place", .type = "sensor_msgs::msg::dds_::Image_"}, {}));
  b.WaitFor("sends values of type sensor_msgs::msg::dds_::Image_");
}

TEST_F(NetworkLinkTest, OfAMessageOneFieldIsTaken) {
  Member b(*engine_, "b");
  b.Take({.topic = "/area", .as = "geometry_msgs/msg/PolygonStamped", .field = "polygon.points[1]"}, b.module.goal);
  b.Begin();
  const auto again = [&](const std::string& field, const TypeInfo& type) {
    const std::lock_guard lock(b.runtime.structure_mutex());
    const auto taken =
        b.network->AddTake({.topic = "/area", .as = "geometry_msgs/msg/PolygonStamped", .field = field}, type);
    return taken ? "" : taken.error().ToString();
  };
  EXPECT_EQ(again("polygon.points[1]", TypeOf<Place>()), "");
  for (const std::string& refused :
       {again("polygon.points[0]", TypeOf<Place>()), again("polygon.points[1].x", TypeOf<double>())}) {
    EXPECT_THAT(refused, testing::AllOf(HasSubstr("'/area' is taken"), HasSubstr("of one topic one field is taken")));
  }
  DiscoveryTable table([] {});
  const auto other = Must(engine_->Join({.name = "other"}, table));
  const auto writer =
      Must(other->MakeWriter({.topic = "rt/area", .type = "geometry_msgs::msg::dds_::PolygonStamped_"}, {}));
  WaitUntil("it is read", [&] { return b.Text().find("written by other") != std::string::npos; });
  const auto write = [&](std::uint32_t points) {
    auto octets = std::make_shared<Octets>();
    CdrWriter message(*octets);
    message.Put(std::int64_t{0});
    message.PutText("map");
    message.PutCount(points);
    for (std::uint32_t i = 0; i < 3 * points; ++i) message.Put(static_cast<float>(i));
    return writer->Write(octets, 1).has_value();
  };
  ASSERT_TRUE(write(3));
  WaitUntil("it has come", [&] { return b.module.goal.Read().has_value(); });
  EXPECT_EQ(b.module.goal.Get().x, 3);
  EXPECT_EQ(b.module.goal.Get().y, 4);
  ASSERT_TRUE(write(1));
  b.WaitFor("polygon.points: it has no element [1], but 1 of them");
  EXPECT_EQ(b.module.goal.Get().x, 3);
  EXPECT_THAT(b.Text(),
              testing::AllOf(HasSubstr("takes /area.polygon.points[1] to "), HasSubstr("1 came, 1 could not be read")));
}

TEST_F(NetworkLinkTest, OctetsThatAreNoValueAreCountedAndChangeNothing) {
  Member b(*engine_, "b");
  b.Take({.topic = "/a/row"}, b.module.wanted);
  b.Begin();
  DiscoveryTable table([] {});
  const auto other = Must(engine_->Join({.name = "other"}, table));
  const auto writer = Must(other->MakeWriter(
      {.topic = "rt/a/row", .type = Must(ValueForm::Make(TypeOf<Row>(), "", ""))->codec->dds_type()}, {}));
  WaitUntil("it is read", [&] { return b.Text().find("written by other") != std::string::npos; });
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    auto octets = std::make_shared<Octets>(random() % 40);
    for (std::byte& each : *octets) each = std::byte(random());
    if (octets->size() > 3)
      (*octets)[0] = (*octets)[2] = (*octets)[3] = std::byte(0), (*octets)[1] = std::byte(random() % 2);
    ASSERT_TRUE(writer->Write(octets, static_cast<std::int64_t>(random())));
  }
  WaitUntilQuiet(*engine_);
  EXPECT_THAT(b.Text(), HasSubstr("could not be read"));
  b.WaitFor("/application/network/a/row: ");  // why the last of them could not
  // One that is a value arrives all the same: little endian, one number.
  auto good = std::make_shared<Octets>(20);
  (*good)[1] = (*good)[4] = std::byte(1);
  ASSERT_TRUE(writer->Write(good, 1));
  WaitUntil("it has come", [&] {
    const auto read = b.module.wanted.Read();
    return read.has_value() && read->values == std::vector<double>{0.0};
  });
}

TEST_F(NetworkLinkTest, TwoPortsThatWouldBeOneTopicAreTold) {
  Member a(*engine_, "a");
  a.runtime.Create<Module1>(a.group, "b.c");
  a.runtime.Create<Module1>(a.group, "b_c");
  a.Offer({.patterns = {"**/place"}});
  a.Begin();
  a.WaitFor("as /application/b.c/output/place is the topic /a/b_c/place already");
}

TEST_F(NetworkLinkTest, APortThatComesLaterIsOfferedAndOneThatGoesIsNot) {
  Member a(*engine_, "a");
  a.Offer({.patterns = {"*/place"}});
  a.Begin();
  Member b(*engine_, "b");
  b.Take({.topic = "/a/late/place"}, b.module.goal);
  b.Begin();
  auto& late = a.runtime.Create<Module1>(a.group, "late");
  ASSERT_TRUE(a.runtime.MakeReady(late));
  WaitUntil("it is read", [&] { return IsConnected(late.place); });
  late.place.Publish({3, 0});
  WaitUntil("it has come", [&] { return b.module.goal.Read().has_value(); });
  ASSERT_TRUE(a.runtime.Delete(late));
  // One of the same name goes on.
  auto& again = a.runtime.Create<Module1>(a.group, "late");
  ASSERT_TRUE(a.runtime.MakeReady(again));
  WaitUntil("it is read again", [&] { return IsConnected(again.place); });
  again.place.Publish({4, 0});
  WaitUntil("the new one's has come", [&] { return b.module.goal.Get().x == 4; });
}

TEST_F(NetworkLinkTest, NoMoreValuesASecondThanAskedFor) {
  Member a(*engine_, "a");
  Member b(*engine_, "b");
  a.Offer({.port = "/application/module/place", .topic = "/slow", .rate = 0.001});
  b.Take({.topic = "/slow"}, b.module.goal);
  a.Begin();
  b.Begin();
  WaitUntil("it is read", [&] { return IsConnected(a.module.place); });
  for (int i = 1; i <= 50; ++i) {
    a.module.place.Publish({1.0 * i, 0});
    WaitUntil("the first has come", [&] { return b.module.goal.Read().has_value(); });
  }
  WaitUntil("it is counted", [&] { return a.Text().find(", 0 sent") == std::string::npos; });
  EXPECT_THAT(a.Text(), HasSubstr(", 1 sent"));
}

TEST(TopicNamesTest, PathsBecomeNamesThatRosAllows) {
  EXPECT_EQ(TopicOfPort("base", "/base/laser/output/scan"), "/base/laser/scan");
  EXPECT_EQ(TopicOfPort("base", "/app/1st laser-x/output/scan"), "/base/_1st_laser_x/scan");
  EXPECT_EQ(TopicOfDistantPath("//base/laser/scan"), "/base/laser/scan");
  EXPECT_EQ(ReadableTopic("rt/scan"), "/scan");
}

// Others may say anything; what is shown of it moves no cursor and sets no colour.
TEST_F(NetworkLinkTest, WhatOneSaysOfItselfMayBeAnything) {
  Member b(*engine_, "b");
  Member a(*engine_, "robot");
  a.structure = "/robot  group\n\n   \n  la\x1b[31mser  module\r\n  sonar  module\n";
  a.Begin();
  b.Begin();
  Result<std::optional<std::string>> sonar = std::optional<std::string>();
  WaitUntil("it is found", [&] { return (sonar = b.StructureOf("//robot/sonar")).has_value() && *sonar; });
  EXPECT_EQ(**sonar, "  sonar  module\n");
  EXPECT_THAT(**b.StructureOf("//robot"), HasSubstr("  la\\x1b[31mser  module\\x0d\n"));
}

TEST_F(NetworkLinkTest, WhatOneIsMadeOfGoesWithItAndComesAnew) {
  Member b(*engine_, "b");
  b.Begin();
  const auto looks = [&](const std::string& path) {
    const auto text = b.StructureOf(path);
    return !text ? text.error().ToString() : text->value_or("");
  };
  for (const std::string text : {"/robot  group\n  laser  module\n", "/robot  group\n  sonar  module\n"}) {
    Member a(*engine_, "robot");
    a.structure = text;
    a.Begin();
    WaitUntil("it tells", [&] { return looks("//robot") == text; });
    WaitUntil("a wrong name is told with the nearest one", [&] {
      return looks("//robt").find("there is no 'robt' in the network; did you mean 'robot'?") != std::string::npos;
    });
    a.End();
    WaitUntil("that it is gone is told",
              [&] { return looks("//robot").find("there is no 'robot' in the network") != std::string::npos; });
    b.WaitFor("robot has left the network");
  }
}

}  // namespace
}  // namespace runnel::test
