#include "plugins/values/foxglove_channel.h"

#include <cmath>
#include <deque>
#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/types/eigen_types.h"
#include "modules/types/drawing.h"
#include "modules/types/measurements.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"

namespace example {

struct Handle {};
struct Robot3 {  // a pose of somebody else, with other numbers and a height
  float heading = 0;
  float x = 0, y = 0, z = 0;
};
struct Liar {
  std::string x;
};
struct Tree {
  std::vector<Tree> branches;
};
void Describe(runnel::TypeBuilder<Handle>& type) { type.Name("Handle"); }
void Describe(runnel::TypeBuilder<Robot3>& type) {
  type.Name("Robot3").SemanticTag("pose").Field("heading", &Robot3::heading).Field("x", &Robot3::x);
  type.Field("y", &Robot3::y).Field("z", &Robot3::z);
}
void Describe(runnel::TypeBuilder<Liar>& type) { type.Name("Liar").SemanticTag("pose").Field("x", &Liar::x); }
void Describe(runnel::TypeBuilder<Tree>& type) { type.Name("Tree").Field("branches", &Tree::branches); }

}  // namespace example

namespace runnel {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;

constexpr Time kStamp{std::chrono::milliseconds(2500)};

template <typename T>
std::vector<std::string> Topics() {
  std::vector<std::string> topics;
  for (const FoxgloveChannel& channel : ChannelsFor(TypeOf<T>(), "/a")) {
    topics.push_back(channel.topic + " " + channel.schema_name);
  }
  return topics;
}

template <typename T>
std::string MessageOf(const FoxgloveChannel& channel, const T& value) {
  std::string json;
  channel.append(&value, kStamp, json);
  return json;
}

template <typename T>
Json Drawn(const T& value) {
  return Json::parse(MessageOf(ChannelsFor(TypeOf<T>(), "/a").at(1), value));
}

const Json kTime = {{"sec", 2}, {"nsec", 500000000}};

Json Xyz(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }

TEST(FoxgloveChannels, AreOneForTheValueAndOneForTheDrawing) {
  EXPECT_THAT(Topics<Pose2>(), ElementsAre("/a Pose2", "/a/foxglove foxglove.PoseInFrame"));
  EXPECT_THAT(Topics<Path2>(), ElementsAre("/a Path2", "/a/foxglove foxglove.PosesInFrame"));
  EXPECT_THAT(Topics<RangeScan>(), ElementsAre("/a RangeScan", "/a/foxglove foxglove.LaserScan"));
  EXPECT_THAT(Topics<Image>(), ElementsAre("/a Image", "/a/foxglove foxglove.RawImage"));
  EXPECT_THAT(Topics<Point2>(), ElementsAre("/a Point2", "/a/foxglove foxglove.SceneUpdate"));
  EXPECT_THAT(Topics<WorldMap>(), ElementsAre("/a WorldMap", "/a/foxglove foxglove.SceneUpdate"));
  EXPECT_THAT(Topics<Contact>(), ElementsAre("/a Contact"));
  EXPECT_THAT(Topics<double>(), ElementsAre("/a double"));
  EXPECT_THAT(Topics<example::Handle>(), ElementsAre());
  EXPECT_THAT(Topics<example::Liar>(), ElementsAre("/a Liar")) << "it has not the fields";
}

TEST(FoxgloveChannels, ShowValuesAsTheyAre) {
  const auto pose = ChannelsFor(TypeOf<Pose2>(), "/a").at(0);
  EXPECT_EQ(MessageOf(pose, Pose2{1, 2, 0.5}), R"({"x":1,"y":2,"heading":0.5})");
  EXPECT_EQ(Json::parse(pose.schema)["properties"]["heading"]["description"], "[rad]");

  const auto number = ChannelsFor(TypeOf<double>(), "/a").at(0);
  EXPECT_EQ(MessageOf(number, 0.5), R"({"value":0.5})");
  EXPECT_EQ(Json::parse(number.schema)["properties"]["value"]["type"], "number");
  EXPECT_EQ(Json::parse(number.schema)["type"], "object");
}

TEST(FoxgloveChannels, HaveInfinityOnlyIfAsked) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(MessageOf(ChannelsFor(TypeOf<double>(), "/a").at(0), infinity), R"({"value":null})");
  EXPECT_EQ(MessageOf(ChannelsFor(TypeOf<double>(), "/a", {.has_infinity = true}).at(0), infinity),
            R"({"value":1e999})");
}

// Foxglove refuses channels with such schemas.
TEST(FoxgloveChannels, HaveNoSchemaForListsOfLists) {
  EXPECT_EQ(ChannelsFor(TypeOf<Eigen::MatrixXd>(), "/a").at(0).schema, "");
  EXPECT_EQ(ChannelsFor(TypeOf<std::vector<std::vector<int>>>(), "/a").at(0).schema, "");
  EXPECT_NE(ChannelsFor(TypeOf<std::vector<Path2>>(), "/a").at(0).schema, "");
  EXPECT_NE(ChannelsFor(TypeOf<example::Tree>(), "/a").at(0).schema, "");
}

TEST(FoxgloveDrawings, OfAPoseHavePlaceAndTurn) {
  const Json message = Drawn(Pose2{1, 2, std::acos(-1.0) / 2});
  EXPECT_EQ(message["timestamp"], kTime);
  EXPECT_EQ(message["frame_id"], "world");
  EXPECT_EQ(message["pose"]["position"], Xyz(1, 2, 0));
  EXPECT_NEAR(message["pose"]["orientation"]["z"], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(message["pose"]["orientation"]["w"], std::sqrt(0.5), 1e-12);
}

TEST(FoxgloveDrawings, GoBySemanticTagAndNotByType) {
  const Json message = Drawn(example::Robot3{.heading = 0, .x = 1, .y = 2, .z = 3});
  EXPECT_EQ(message["pose"]["position"], Xyz(1, 2, 3));
}

TEST(FoxgloveDrawings, OfTheRobotAreATransformToo) {
  const auto channel = TransformChannelFor(TypeOf<Pose2>());
  ASSERT_TRUE(channel);
  EXPECT_EQ(channel->topic, "/tf");
  EXPECT_EQ(channel->schema_name, "foxglove.FrameTransform");
  const Json message = Json::parse(MessageOf(*channel, Pose2{3, 4, 0}));
  EXPECT_EQ(message["parent_frame_id"], "world");
  EXPECT_EQ(message["child_frame_id"], "robot");
  EXPECT_EQ(message["translation"], Xyz(3, 4, 0));
  EXPECT_EQ(message["rotation"]["w"], 1);
  EXPECT_FALSE(TransformChannelFor(TypeOf<Point2>()));
}

TEST(FoxgloveDrawings, OfAPathLookWhereItGoes) {
  const Json message = Drawn(Path2{{{0, 0}, {1, 0}, {1, 5}}});
  ASSERT_EQ(message["poses"].size(), 3u);
  EXPECT_EQ(message["poses"][0]["orientation"]["w"], 1);
  EXPECT_NEAR(message["poses"][1]["orientation"]["z"], std::sqrt(0.5), 1e-12);
  EXPECT_EQ(message["poses"][2]["orientation"], message["poses"][1]["orientation"]);
  EXPECT_EQ(message["poses"][2]["position"], Xyz(1, 5, 0));
  EXPECT_EQ(Drawn(Path2{})["poses"].size(), 0u);
}

TEST(FoxgloveDrawings, OfAScanKeepWhatMetNothing) {
  const RangeScan scan{-1, 0.5, 0.1, 4, {1.5F, std::numeric_limits<float>::infinity(), 2}};
  const std::string json = MessageOf(ChannelsFor(TypeOf<RangeScan>(), "/a").at(1), scan);
  EXPECT_THAT(json, testing::HasSubstr(R"("ranges":[1.5,1e999,2])"));
  EXPECT_THAT(json, testing::HasSubstr(R"("start_angle":-1,"end_angle":0,)"));
  EXPECT_THAT(json, testing::HasSubstr(R"("frame_id":"robot")"));
  EXPECT_EQ(Drawn(RangeScan{})["end_angle"], 0) << "no rays at all";
}

TEST(FoxgloveDrawings, OfAnImageHaveItsBytes) {
  const Json message = Drawn(Image{2, 1, "rgb8", 6, {255, 254, 0, 1, 2, 3}});
  EXPECT_EQ(message["width"], 2);
  EXPECT_EQ(message["height"], 1);
  EXPECT_EQ(message["step"], 6);
  EXPECT_EQ(message["encoding"], "rgb8");
  EXPECT_EQ(message["data"], "//4AAQID");
  EXPECT_EQ(Drawn(Image{})["data"], "");
}

// The schemas that a robot in the tests uses are compared with Foxglove's package; this one is not used.
TEST(FoxgloveDrawings, OfAnImageHaveFoxglovesSchema) {
  EXPECT_EQ(Json::parse(ChannelsFor(TypeOf<Image>(), "/a").at(1).schema), Json::parse(R"({
      "title": "foxglove.RawImage", "type": "object", "properties": {
        "timestamp": {"type": "object", "title": "time", "properties": {
          "sec": {"type": "integer", "minimum": 0},
          "nsec": {"type": "integer", "minimum": 0, "maximum": 999999999}}},
        "frame_id": {"type": "string"},
        "width": {"type": "integer", "minimum": 0},
        "height": {"type": "integer", "minimum": 0},
        "encoding": {"type": "string"},
        "step": {"type": "integer", "minimum": 0},
        "data": {"type": "string", "contentEncoding": "base64"}}})"));
}

TEST(FoxgloveDrawings, OfHitAndLeavePointsAreNumbered) {
  const Json message = Drawn(HitAndLeavePoints{{{1, 2}, {3, 4}}, {{5, 6}}});
  const Json& hits = message["entities"][0];
  EXPECT_EQ(hits["id"], "hit");
  ASSERT_EQ(hits["spheres"].size(), 2u);
  EXPECT_EQ(hits["spheres"][1]["pose"]["position"], Xyz(3, 4, 0));
  EXPECT_EQ(hits["texts"][1]["text"], "hit 2");
  EXPECT_EQ(message["entities"][1]["spheres"].size(), 1u);
}

TEST(FoxgloveDrawings, OfAMapHaveSidesForEachOutline) {
  WorldMap map;
  map.goal = {7, 8};
  map.outlines.push_back({{{0, 0}, {1, 0}, {1, 1}}, 0.5, false});
  map.outlines.push_back({{{5, 5}, {6, 5}, {6, 6}, {5, 6}}, 1.0, false});
  map.bounds = {{-9, -9}, {9, -9}, {0, 9}};
  const Json entities = Drawn(map)["entities"];
  ASSERT_EQ(entities.size(), 3u);
  const Json& obstacles = entities[0];
  EXPECT_EQ(obstacles["lines"].size(), 5u) << "two for each obstacle, one for the bounds";
  EXPECT_EQ(obstacles["lines"][3]["points"][0], Xyz(5, 5, 1));
  const Json& sides = obstacles["triangles"][0];
  EXPECT_EQ(sides["points"].size(), 2u * (3 + 4));
  EXPECT_EQ(sides["indices"].size(), 6u * (3 + 4) + 3u * (1 + 2)) << "sides and tops";
  for (const Json& index : sides["indices"]) EXPECT_LT(index, sides["points"].size());
  // The last side of the first obstacle closes it; then comes its top.
  EXPECT_EQ(sides["indices"][17], 1);
  for (std::size_t i = 18; i < 21; ++i) {
    EXPECT_EQ(sides["points"][sides["indices"][i].get<std::size_t>()]["z"], 0.5);
  }
  EXPECT_EQ(entities[1]["id"], "start");
  EXPECT_EQ(entities[2]["spheres"][0]["pose"]["position"], Xyz(7, 8, 0));
}

TEST(FoxgloveDrawings, OfAMapLeaveOpenWhatHasHoles) {
  WorldMap map;
  map.outlines.push_back({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, 1.0, false});
  map.outlines.push_back({{{1, 1}, {2, 1}, {2, 2}}, 1.0, true});
  const Json entities = Drawn(map)["entities"];
  EXPECT_EQ(entities[0]["triangles"][0]["indices"].size(), 6u * (4 + 3));
}

TEST(FoxgloveDrawings, HaveNoTimeBeforeTheBegin) {
  std::string json;
  const Pose2 pose;
  ChannelsFor(TypeOf<Pose2>(), "/a").at(1).append(&pose, Time(Duration(-5)), json);
  EXPECT_EQ(Json::parse(json)["timestamp"], (Json{{"sec", 0}, {"nsec", 0}}));
}

}  // namespace
}  // namespace runnel
