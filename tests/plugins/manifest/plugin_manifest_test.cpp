#include "plugins/manifest/plugin_manifest.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/manifest/module_description.h"
#include "plugins/parameters/parameter.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

enum class Side { kLeft, kRight };
inline void Describe(TypeBuilder<Side>& type) {
  type.Name("test::Side").Value("left", Side::kLeft).Value("right", Side::kRight);
}

int modules_made = 0;

class Sonar final : public Module {
 public:
  explicit Sonar(const Placement& placement) : Module(placement) { ++modules_made; }
  Input<double> trigger{this, "trigger", {.description = "\"go\" & <measure>", .required = true}};
  Output<float> range{this, "range"};
  Parameter<double> limit{
      this, "limit", {.default_value = 2.5, .bounds = {0, 5}, .unit = "m", .description = "at most"}};
  Parameter<Side> side{this, "side", {.default_value = Side::kRight}};
  StaticParameter<std::string> device{this, "device", {.default_value = "/dev/sonar"}};

 private:
  void Update() override {}
};

class Broken final : public Module {
 public:
  explicit Broken(const Placement& placement) : Module(placement) { throw std::runtime_error("there is no driver"); }

 private:
  void Update() override {}
};

class PluginManifestTest : public testing::Test {
 protected:
  PluginManifestTest() {
    Add<Sonar>("test/sonar");
    Add<Broken>("test/broken");
    fs::create_symlink("/proc/self/exe", library);
    modules_made = 0;
  }

  template <typename M>
  void Add(const std::string& name) {
    const auto added = modules.Add(
        {name, "a summary", "test", [](const Placement& placement) { return std::make_unique<M>(placement); }});
    EXPECT_TRUE(added);
  }
  PluginManifest Made() {
    PluginManifest manifest{.plugin = "test", .build_id = BuildIdOf(library).value(), .modules = {}};
    for (const char* type : {"test/sonar", "test/broken"}) {
      manifest.modules.push_back(DescribeByMaking(runtime, modules, type).value());
    }
    return manifest;
  }
  void Write(const std::string& text) { std::ofstream(ManifestFileOf(library), std::ios::trunc) << text; }
  ModuleDescriber Describer() {
    return {runtime, modules, [this](const std::string&) { return library.string(); }};
  }

  TemporaryFolder folder;
  fs::path library = folder.path() / "test.so";
  Runtime runtime;
  ModuleRegistry modules;
};

TEST_F(PluginManifestTest, SaysWhatModulesLookLike) {
  Write(ManifestText(Made()));
  const auto read = ReadManifest(library);
  ASSERT_TRUE(read) << read.error().ToString();
  EXPECT_EQ(read->plugin, "test");
  ASSERT_THAT(read->modules, SizeIs(2));
  const ModuleDescription& sonar = read->modules[0];
  EXPECT_EQ(sonar.type, "test/sonar");
  EXPECT_EQ(sonar.summary, "a summary");
  ASSERT_THAT(sonar.ports, SizeIs(2));
  EXPECT_EQ(sonar.ports[0].PathInModule(), "trigger");
  EXPECT_TRUE(sonar.ports[0].is_input);
  EXPECT_TRUE(sonar.ports[0].is_required);
  EXPECT_EQ(sonar.ports[0].description, "\"go\" & <measure>");
  EXPECT_EQ(sonar.ports[1].type, "float");
  EXPECT_FALSE(sonar.ports[1].is_input);
  ASSERT_THAT(sonar.parameters, SizeIs(3));
  EXPECT_EQ(sonar.parameters[0].default_value, "2.5");
  EXPECT_EQ(sonar.parameters[0].unit, "m");
  EXPECT_EQ(sonar.parameters[0].maximum, 5);
  EXPECT_THAT(sonar.parameters[1].choices, ElementsAre("left", "right"));
  EXPECT_EQ(sonar.parameters[1].minimum, std::nullopt);
  EXPECT_FALSE(sonar.parameters[1].is_static);
  EXPECT_TRUE(sonar.parameters[2].is_static);
  EXPECT_THAT(read->modules[1].problem, HasSubstr("there is no driver"));
}

TEST_F(PluginManifestTest, OfAnotherBuildIsRefused) {
  PluginManifest manifest = Made();
  manifest.build_id = "0123";
  Write(ManifestText(manifest));
  const auto read = ReadManifest(library);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("another build"));
  EXPECT_THAT(read.error().hint, HasSubstr("runnel manifest"));
}

TEST_F(PluginManifestTest, WhatIsNoneIsRefusedWithItsPlace) {
  EXPECT_FALSE(ReadManifest(library)) << "there is none";
  Write("<plugin");
  EXPECT_FALSE(ReadManifest(library));
  Write("<plugin build_id=\"" + BuildIdOf(library).value() + "\">\n <modul/>\n</plugin>");
  const auto read = ReadManifest(library);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().position.line, 2);
}

TEST_F(PluginManifestTest, ABuildIdIsOfALibrary) {
  EXPECT_THAT(BuildIdOf(library).value(), testing::MatchesRegex("[0-9a-f]+"));
  EXPECT_FALSE(BuildIdOf(folder.path() / "missing.so"));
  std::ofstream(folder.path() / "text.so") << "no library at all, but long enough to hold a head of one";
  EXPECT_FALSE(BuildIdOf(folder.path() / "text.so"));
  // Cut off anywhere, nothing outside of the file is read.
  std::ifstream whole(library, std::ios::binary);
  std::string head(4096, '\0');
  whole.read(head.data(), static_cast<std::streamsize>(head.size()));
  for (std::size_t length = 0; length < head.size(); length += 97) {
    std::ofstream(folder.path() / "cut.so", std::ios::trunc) << head.substr(0, length);
    (void)BuildIdOf(folder.path() / "cut.so");
  }
}

TEST_F(PluginManifestTest, NobodyMakesAModuleToKnow) {
  Write(ManifestText(Made()));
  modules_made = 0;
  ModuleDescriber describer = Describer();
  EXPECT_THAT(describer.Describe("test/sonar").value().ports, SizeIs(2));
  EXPECT_EQ(modules_made, 0);
  EXPECT_EQ(describer.Describe("test/sonnar"), std::nullopt);
}

TEST_F(PluginManifestTest, WithoutAManifestOneIsMade) {
  EXPECT_THAT(Describer().Describe("test/sonar").value().ports, SizeIs(2));
  EXPECT_EQ(modules_made, 1);
  Add<Sonar>("test/newer");  // that the manifest does not know
  Write(ManifestText(Made()));
  modules_made = 0;
  EXPECT_THAT(Describer().Describe("test/newer").value().ports, SizeIs(2));
  EXPECT_EQ(modules_made, 1);
  ModuleDescriber unknown(runtime, modules, {});
  EXPECT_THAT(unknown.Describe("test/sonar").value().ports, SizeIs(2));
}

TEST_F(PluginManifestTest, ProgramsReadItAsJson) {
  const auto json = nlohmann::json::parse(JsonText(Made().modules));
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0]["ports"][0]["direction"], "input");
  EXPECT_EQ(json[0]["parameters"][0]["maximum"], 5);
  EXPECT_EQ(json[0]["parameters"][1]["choices"][1], "right");
  EXPECT_EQ(json[0]["problem"], nullptr);
  EXPECT_THAT(json[1]["problem"], HasSubstr("no driver"));
}

}  // namespace
}  // namespace runnel::test
