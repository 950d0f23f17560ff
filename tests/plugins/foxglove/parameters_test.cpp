#include "tests/plugins/foxglove/foxglove_fixture.h"

namespace runnel::test {
namespace {

using testing::Contains;

class FoxgloveParametersTest : public FoxgloveTest {
 protected:
  Json Get(const Json& names) {
    Say({{"op", "getParameters"}, {"parameterNames", names}, {"id", "g"}});
    return Answer("g");
  }
  Json Set(const Json& parameters) {
    Say({{"op", "setParameters"}, {"parameters", parameters}, {"id", "s"}});
    return Answer("s");
  }
  Json Answer(const std::string& id) {
    Json answer;
    EXPECT_TRUE(Wait([&] {
      for (const Json& each : Take("parameterValues")) {
        if (each.value("id", "") == id) answer = each["parameters"];
      }
      return !answer.is_null();
    }));
    return answer;
  }
  static Json Setting(const char* name, const Json& value) { return {{{"name", name}, {"value", value}}}; }
};

TEST_F(FoxgloveParametersTest, AreToldInTheFormOfTheProtocol) {
  Begin();
  const Json all = Get(Json::array());
  EXPECT_EQ(all.size(), 9u);
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/gain"}, {"value", 0.5}, {"type", "float64"}}));
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/count"}, {"value", 3}}));
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/is_on"}, {"value", true}}));
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/side"}, {"value", "left"}}));
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/patience"}, {"value", "20ms"}}));
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/title"}, {"value", "R2"}}));
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/offset"}, {"value", {{"x", 1}, {"y", 2}, {"heading", 3}}}}));
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/weights"}, {"value", {0.5, 1}}, {"type", "float64_array"}}));
  EXPECT_THAT(all, Contains(Json{{"name", "/robot/bytes"}, {"value", "Af8="}, {"type", "byte_array"}}));
}

TEST_F(FoxgloveParametersTest, AreSetAndToldAsTheyAreThen) {
  Begin();
  EXPECT_EQ(Set(Setting("/robot/gain", 1.25)).at(0)["value"], 1.25);
  EXPECT_EQ(robot.gain.Get(), 1.25);
  Set(Setting("/robot/count", -7));
  EXPECT_EQ(robot.count.Get(), -7);
  Set(Setting("/robot/is_on", false));
  EXPECT_FALSE(robot.is_on.Get());
  Set(Setting("/robot/side", "right"));
  EXPECT_EQ(robot.side.Get(), Side::kRight);
  Set(Setting("/robot/patience", "1.5s"));
  EXPECT_EQ(robot.patience.Get(), std::chrono::milliseconds(1500));
  Set(Setting("/robot/patience", {{"sec", 2}, {"nsec", 5}}));
  EXPECT_EQ(robot.patience.Get(), Duration(2'000'000'005));
  Set(Setting("/robot/offset", {{"y", 7}}));
  EXPECT_EQ(robot.offset.Get(), (Pose2{1, 7, 3})) << "what is left out stays";
  EXPECT_EQ(Complaint(), "");
}

TEST_F(FoxgloveParametersTest, AreNotSetToWhatTheyCannotBe) {
  Begin();
  const auto complaint_of = [this](const Json& setting) {
    Set(setting);
    return Complaint();
  };
  EXPECT_THAT(complaint_of(Setting("/robot/gain", 5)), HasSubstr("0 .. 2"));
  EXPECT_EQ(robot.gain.Get(), 0.5);
  EXPECT_THAT(complaint_of(Setting("/robot/gain", true)), HasSubstr("expected a number"));
  EXPECT_THAT(complaint_of(Setting("/robot/count", 1.5)), HasSubstr("'1.5' does not fit"));
  EXPECT_THAT(complaint_of(Setting("/robot/side", "rihgt")), HasSubstr("did you mean 'right'?"));
  EXPECT_THAT(complaint_of(Setting("/robot/gian", 1)), HasSubstr("did you mean '/robot/gain'?"));
  EXPECT_THAT(complaint_of(Setting("/robot/offset", {{"z", 1}})), HasSubstr("no field 'z'"));
  EXPECT_THAT(complaint_of({{{"name", "/robot/gain"}}}), HasSubstr("cannot be removed"));
  EXPECT_THAT(complaint_of({{{"name", "/robot/gain"}, {"value", "%"}, {"type", "byte_array"}}}), HasSubstr("base64"));
  EXPECT_THAT(complaint_of({{{"name", "/robot/gain"}, {"value", "AAA="}, {"type", "byte_array"}}}),
              HasSubstr("no list of bytes"));
  EXPECT_THAT(complaint_of(Setting("/robot/title", "R3")), HasSubstr("title"))
      << "static: it cannot be set while the module runs";
}

TEST_F(FoxgloveParametersTest, AreSetEachForItself) {
  Begin();
  Set({{{"name", "/robot/gain"}, {"value", 99}}, {{"name", "/robot/count"}, {"value", 9}}});
  EXPECT_EQ(robot.count.Get(), 9);
  EXPECT_THAT(Complaint(), HasSubstr("gain"));
}

TEST_F(FoxgloveParametersTest, AreNotSetByThoseWhoMayOnlyLook) {
  Begin(/*is_read_only=*/true);
  Say({{"op", "setParameters"}, {"parameters", Setting("/robot/gain", 1)}});
  EXPECT_THAT(Complaint(), HasSubstr("setParameters: viewers may only look"));
  Turn();
  EXPECT_EQ(robot.gain.Get(), 0.5);
  EXPECT_EQ(Get({"/robot/gain"}).at(0)["value"], 0.5) << "but they may look";
}

TEST_F(FoxgloveParametersTest, AreToldWhenTheyChange) {
  Begin();
  Say({{"op", "subscribeParameterUpdates"}, {"parameterNames", {"/robot/gain", "/robot/count"}}});
  EXPECT_TRUE(Wait([this] { return !Take("parameterValues").empty(); }));
  ASSERT_TRUE(robot.gain.Set(1.5));
  ASSERT_TRUE(robot.is_on.Set(false));
  std::vector<Json> told;
  EXPECT_TRUE(Wait([&] { return !(told = Take("parameterValues")).empty(); }));
  EXPECT_EQ(told.at(0)["parameters"], (Json{{{"name", "/robot/gain"}, {"value", 1.5}, {"type", "float64"}}}));
  Say({{"op", "unsubscribeParameterUpdates"}, {"parameterNames", Json::array()}});
  ASSERT_TRUE(robot.gain.Set(1.75));
  // Long after it would have been told.
  for (int i = 0; i < 10; ++i) Turn();
  EXPECT_THAT(Take("parameterValues"), IsEmpty());
  EXPECT_EQ(Complaint(), "");
  Say({{"op", "subscribeParameterUpdates"}, {"parameterNames", {"/robot/counts"}}});
  EXPECT_THAT(Complaint(), HasSubstr("did you mean '/robot/count'?"));
}

TEST_F(FoxgloveParametersTest, ThatAreNotThereAreNamed) {
  Begin();
  EXPECT_EQ(Get({"/robot/gian", "/robot/count"}).size(), 1u);
  EXPECT_THAT(Complaint(), HasSubstr("there is no parameter '/robot/gian'; did you mean"));
}

}  // namespace
}  // namespace runnel::test
