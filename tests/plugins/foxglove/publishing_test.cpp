#include <mutex>

#include "tests/plugins/foxglove/foxglove_fixture.h"

namespace runnel::test {
namespace {

class FoxglovePublishingTest : public FoxgloveTest {
 protected:
  void Advertise(std::uint32_t id, const std::string& topic, const std::string& encoding = "json") {
    Say({{"op", "advertise"},
         {"channels", {{{"id", id}, {"topic", topic}, {"encoding", encoding}, {"schemaName", "any"}}}}});
  }
  bool WaitForGoal(const Point2& wanted) {
    return Wait([&] {
      const auto goal = robot.goal.Read();
      return goal && *goal == wanted;
    });
  }
  std::size_t SourcesOf(const Port& input) {
    const std::lock_guard lock(runtime.structure_mutex());
    return input.incoming().size();
  }
  /// The names of what clients have brought.
  std::vector<std::string> Brought() {
    const std::lock_guard lock(runtime.structure_mutex());
    std::vector<std::string> names;
    for (const FrameworkElement* each : runtime.root().children()) {
      if (each != &application) names.push_back(each->name());
    }
    return names;
  }
};

TEST_F(FoxglovePublishingTest, FillsInputs) {
  Begin();
  Advertise(5, "/robot/goal");
  Publish(5, R"({"x":3,"y":4})");
  EXPECT_TRUE(WaitForGoal({3, 4})) << "though the output was not there yet";
  Publish(5, R"({"x":5,"y":6})");
  EXPECT_EQ(*robot.goal.Read(), (Point2{5, 6}));
  Publish(5, R"({"y":7})");
  EXPECT_EQ(*robot.goal.Read(), (Point2{0, 7})) << "what is left out is as usual";
  EXPECT_EQ(Complaint(), "");
}

TEST_F(FoxglovePublishingTest, TakesPathsAndBareValues) {
  Begin();
  Advertise(1, "/application/robot/input/limit");
  const auto wait_for = [this](double wanted) {
    return Wait([&] {
      const auto limit = robot.limit.Read();
      return limit && *limit == wanted;
    });
  };
  Publish(1, R"( { "value" : 1.5 } )");
  EXPECT_TRUE(wait_for(1.5));
  Publish(1, "2.5");
  EXPECT_TRUE(wait_for(2.5));
  EXPECT_EQ(Complaint(), "");
}

TEST_F(FoxglovePublishingTest, GoesThroughTheInterfaceOfAGroup) {
  auto& group = runtime.Create<Group>(application, "group");
  auto& inner = runtime.Create<Robot>(group, "inner");
  auto& way_in = runtime.Create<ProxyPort>(group, "goal", Port::Direction::kInput, TypeOf<Point2>());
  auto& blind = runtime.Create<ProxyPort>(group, "blind", Port::Direction::kInput, TypeOf<Point2>());
  ASSERT_TRUE(runtime.MakeReady(group));
  ASSERT_TRUE(Port::Connect(way_in, inner.goal));
  Begin();
  Advertise(1, "/group/goal");
  Publish(1, R"({"x":1,"y":2})");
  EXPECT_TRUE(Wait([&] { return inner.goal.Read().has_value(); }));
  EXPECT_EQ(Complaint(), "");
  Advertise(2, "/group/blind");
  std::string complaint;
  EXPECT_TRUE(Wait([&] { return !(complaint = Complaint()).empty(); }));
  EXPECT_THAT(complaint, HasSubstr(blind.path()));
  EXPECT_THAT(complaint, HasSubstr("nothing is connected"));
}

TEST_F(FoxglovePublishingTest, TellsWhatIsWrongWithAValue) {
  Begin();
  Advertise(5, "/robot/goal");
  Publish(5, R"({"x":3,"y":4})");
  ASSERT_TRUE(WaitForGoal({3, 4}));
  Publish(5, R"({"x":1,"z":4})");
  EXPECT_EQ(Complaint(), "/application/robot/input/goal: Point2 has no field 'z'; did you mean 'x'?");
  Publish(5, "");
  EXPECT_THAT(Complaint(), HasSubstr("unexpected end of input"));
  EXPECT_EQ(*robot.goal.Read(), (Point2{3, 4})) << "nothing of it is published";
}

TEST_F(FoxglovePublishingTest, NamesInputsThatAreNone) {
  Begin();
  Advertise(1, "/robot/gaol");
  EXPECT_THAT(Complaint(), HasSubstr("did you mean '/robot/goal'?"));
  Advertise(1, "/robot/pose");
  EXPECT_THAT(Complaint(), HasSubstr("'/robot/pose' is no input"));
  Advertise(1, "/robot/secret");
  EXPECT_THAT(Complaint(), HasSubstr("'/robot/secret' is no input")) << "of an opaque type";
  Advertise(1, "/robot/goal", "protobuf");
  EXPECT_THAT(Complaint(), HasSubstr("'json' here, not as 'protobuf'"));
  Publish(1, "{}");
  EXPECT_EQ(Complaint(), "channel 1 is not advertised");
  Advertise(1, "/robot/goal");
  EXPECT_EQ(Complaint(), "");
  Advertise(1, "/robot/limit");
  EXPECT_EQ(Complaint(), "advertise: channel 1 is in use");
}

TEST_F(FoxglovePublishingTest, LeavesNothingBehind) {
  Begin();
  Advertise(1, "/robot/goal");
  Advertise(2, "/robot/limit");
  ASSERT_TRUE(Wait([this] { return Brought().size() == 2; }));
  ASSERT_TRUE(Wait([this] { return SourcesOf(robot.goal) == 1; }));
  Say({{"op", "unadvertise"}, {"channelIds", {1}}});
  EXPECT_TRUE(Wait([this] { return Brought().size() == 1; }));
  EXPECT_EQ(SourcesOf(robot.goal), 0u);
  Say({{"op", "unadvertise"}, {"channelIds", {1}}});
  EXPECT_EQ(Complaint(), "unadvertise: channel 1 is not advertised");
  session = nullptr;
  protocol = {};
  EXPECT_THAT(Brought(), IsEmpty());
  EXPECT_EQ(SourcesOf(robot.limit), 0u);
}

TEST_F(FoxglovePublishingTest, IsNotShownAsAChannel) {
  Begin();
  Channels();
  Advertise(1, "/robot/goal");
  ASSERT_TRUE(Wait([this] { return SourcesOf(robot.goal) == 1; }));
  Turn();
  EXPECT_THAT(Take("advertise"), IsEmpty());
}

TEST_F(FoxglovePublishingTest, EndsWithTheInput) {
  auto& other = runtime.Create<Robot>(application, "other");
  ASSERT_TRUE(runtime.MakeReady(other));
  Begin();
  Advertise(1, "/other/goal");
  ASSERT_TRUE(Wait([&] { return SourcesOf(other.goal) == 1; }));
  ASSERT_TRUE(runtime.Delete(other));
  std::string complaint;
  EXPECT_TRUE(Wait([&] { return !(complaint = Complaint()).empty(); }));
  EXPECT_THAT(complaint, HasSubstr("channel 1 is closed: its input is gone"));
  EXPECT_TRUE(Wait([this] { return Brought().empty(); }));
}

TEST_F(FoxglovePublishingTest, EndsWithItsOutputThatAnybodyMayDelete) {
  Begin();
  Advertise(1, "/robot/goal");
  Publish(1, R"({"x":1})");
  ASSERT_TRUE(WaitForGoal({1, 0}));
  ASSERT_TRUE(runtime.Delete(*runtime.root().FindChild(Brought().at(0))));
  Publish(1, R"({"x":2})");
  EXPECT_THAT(Complaint(), HasSubstr("the output of this channel has been deleted"));
  EXPECT_FALSE(robot.goal.Read().has_value());
  Say({{"op", "unadvertise"}, {"channelIds", {1}}});
  Advertise(1, "/robot/goal");
  Publish(1, R"({"x":3})");
  EXPECT_TRUE(WaitForGoal({3, 0}));
  EXPECT_EQ(Complaint(), "");
}

TEST_F(FoxglovePublishingTest, WaitsForTheStructureWithoutStandingStill) {
  Begin();
  Advertise(1, "/robot/goal");
  Publish(1, R"({"x":1})");
  ASSERT_TRUE(WaitForGoal({1, 0}));
  {
    const HeldStructure held(runtime);
    Publish(1, R"({"x":2})");
    Publish(1, R"({"x":3})");
    EXPECT_EQ(*robot.goal.Read(), (Point2{1, 0}));
  }
  EXPECT_TRUE(WaitForGoal({3, 0}));
}

TEST_F(FoxglovePublishingTest, IsNotForThoseWhoMayOnlyLook) {
  Begin(/*is_read_only=*/true);
  Advertise(1, "/robot/goal");
  EXPECT_THAT(Complaint(), HasSubstr("advertise: viewers may only look"));
  Turn();
  EXPECT_THAT(Brought(), IsEmpty());
}

TEST_F(FoxglovePublishingTest, HasAnEnd) {
  Begin();
  for (std::uint32_t i = 0; i < 100; ++i) Advertise(i, "/robot/goal");
  EXPECT_EQ(Complaint(), "");
  Advertise(100, "/robot/goal");
  EXPECT_EQ(Complaint(), "advertise: more than 100 channels");
}

}  // namespace
}  // namespace runnel::test
