// What viewers see besides values: pictures, how long modules take, what saving would change.

#include <cstdint>

#include <gmock/gmock.h>

#include "tests/plugins/inspector/inspector_fixture.h"

namespace runnel::test {
namespace {

using ::testing::HasSubstr;

struct Picture {
  std::uint32_t width = 2;
  std::uint32_t height = 1;
  std::string encoding = "rgb8";
  std::uint32_t row_stride = 6;
  std::vector<std::uint8_t> data{255, 0, 0, 0, 0, 255};
};

void Describe(TypeBuilder<Picture>& type) {
  type.Name("test::Picture").SemanticTag("image").Field("width", &Picture::width);
  type.Field("height", &Picture::height).Field("encoding", &Picture::encoding);
  type.Field("row_stride", &Picture::row_stride).Field("data", &Picture::data);
}

class Eye final : public Module {
 public:
  using Module::Module;
  Output<Picture> picture{this, "picture"};

 private:
  void Update() override { picture.Publish(Picture{}); }
};

class Passing final : public Module {
 public:
  using Module::Module;
  Input<int> in{this, "in"};
  Output<int> out{this, "out"};

 private:
  void Update() override {
    const auto value = in.Read();
    if (value.is_new()) out.Publish(*value);
  }
};

class LookingDeeper : public RunningInspectorTest {
 protected:
  LookingDeeper() {
    Register<Eye>("test/eye");
    Register<Passing>("test/passing");
  }
};

TEST_F(LookingDeeper, PicturesComeAsBrowsersTakeThem) {
  Start();
  Apply("create /app/eye test/eye");
  Viewer viewer = View();
  const std::string path = "/app/eye/output/picture";
  viewer.Send({{"op", "watch"}, {"path", path}, {"rate", 60}, {"as", "image"}});
  const Json item = viewer.Value(path);
  EXPECT_EQ(item["value"]["width"], 2);
  EXPECT_EQ(item["value"]["step"], 6);
  EXPECT_EQ(item["value"]["encoding"], "rgb8");
  EXPECT_EQ(item["value"]["data"], "/wAAAAD/");
  EXPECT_EQ(item["bytes"], 4 + 4 + 4 + 4 + 6);
  viewer.Send({{"op", "watch"}, {"path", path}, {"rate", 60}, {"elements", 3}});
  while (viewer.Value(path)["value"]["data"] != Json::array({255, 0, 0})) {
  }
}

TEST_F(LookingDeeper, ModulesAreMeasuredWhileSomebodyWantsToKnow) {
  Start();
  Viewer viewer = View();
  viewer.Send({{"op", "watch_rates"}, {"rate", 10}});
  EXPECT_EQ(viewer.Ask({{"op", "profile"}, {"on", true}})["ok"], true);
  Json profile = viewer.Next("profile");
  while (profile["tasks"].empty()) profile = viewer.Next("profile");
  EXPECT_EQ(profile["on"], true);
  EXPECT_EQ(profile["tasks"][0]["path"], "/app/a");
  EXPECT_GE(profile["tasks"][0]["runs"], 0);
  EXPECT_EQ(viewer.Ask({{"op", "profile"}, {"on", false}})["ok"], true);
  while (viewer.Next("profile")["on"] != false) {
  }
}

TEST_F(LookingDeeper, TheLatencyOfAChainIsMeasuredAndNoMore) {
  Start();
  Apply("create /app/c test/passing\nconnect /app/a/output/out /app/c/input/in");
  Viewer viewer = View();
  viewer.Send({{"op", "watch_rates"}, {"rate", 10}});
  Json request{{"op", "latency"}, {"from", "/app/a/output/out"}, {"to", "/app/c/output/out"}};
  const Json reply = viewer.Ask(request);
  ASSERT_EQ(reply["ok"], true) << reply.dump();
  Json profile = viewer.Next("profile");
  while (profile["latencies"].empty() || profile["latencies"][0]["runs"] == 0) {
    profile = viewer.Next("profile");
  }
  EXPECT_EQ(profile["latencies"][0]["from"], "/app/a/output/out");
  EXPECT_EQ(profile["latencies"][0]["modules"].back(), "/app/c");
  request["on"] = false;
  EXPECT_EQ(viewer.Ask(request)["ok"], true);
  EXPECT_EQ(viewer.Ask(request)["ok"], false) << "there is none any more";
  request["to"] = "/app/c/output/ouch";
  request["on"] = true;
  EXPECT_EQ(viewer.Ask(request)["ok"], false);
}

TEST_F(LookingDeeper, SingleModulesArePaused) {
  std::string told;
  hooks.set_paused = [&](const std::string& path, bool is_paused) -> Result<void> {
    told = path + (is_paused ? " stands" : " runs");
    return {};
  };
  Start();
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "pause"}, {"path", "/app/a"}})["ok"], true);
  EXPECT_EQ(told, "/app/a stands");
  EXPECT_EQ(viewer.Ask({{"op", "resume"}, {"path", "/app/a"}})["ok"], true);
  EXPECT_EQ(told, "/app/a runs");
}

TEST_F(LookingDeeper, WhatSavingWouldChangeIsToldToWhoMaySave) {
  hooks.preview_save = [](const std::string& file) -> Result<ServiceHooks::SaveDifference> {
    return ServiceHooks::SaveDifference{file.empty() ? "/here/app.xml" : file, "old\n", "new\n"};
  };
  Start({.file = "/here/app.xml"});
  Viewer viewer = View();
  const Json reply = viewer.Ask({{"op", "preview"}});
  ASSERT_EQ(reply["ok"], true) << reply.dump();
  EXPECT_EQ(reply["file"], "/here/app.xml");
  EXPECT_EQ(reply["before"], "old\n");
  EXPECT_EQ(reply["after"], "new\n");
  const Json elsewhere = viewer.Ask({{"op", "preview"}, {"file", "../etc/app.xml"}});
  EXPECT_EQ(elsewhere["ok"], false);
  EXPECT_THAT(elsewhere["errors"][0]["hint"], HasSubstr("/here"));
}

}  // namespace
}  // namespace runnel::test
