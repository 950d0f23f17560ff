// Tags and attributes that plugins add.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/application_files/path_use.h"
#include "tests/plugins/application_files/reading/test_application.h"

namespace runnel::testing {
namespace {

class Beacon final : public FrameworkElement {
 public:
  explicit Beacon(const Placement& placement, std::size_t strength)
      : FrameworkElement(placement), strength_(strength) {}
  [[nodiscard]] std::size_t strength() const { return strength_; }

 private:
  const std::size_t strength_;
};

XmlTag BeaconTag() {
  return {.name = "beacon",
          .parents = {"application", "group"},
          .attributes = {{.name = "name", .kind = AttributeKind::kName, .required = true},
                         {.name = "strength", .kind = AttributeKind::kCount}},
          .handle = [](const TagUse& use) -> FrameworkElement* {
            const XmlAttribute* const strength = use.Find("strength");
            return &use.context.runtime().Create<Beacon>(use.parent, use.Get("name").value,
                                                         strength != nullptr ? ParseCount(strength->value).value() : 1);
          }};
}

AddedAttribute NearAttribute(std::vector<std::string>& seen) {
  return {.tag = "module",
          .rule = {.name = "near", .kind = AttributeKind::kPath},
          .handle = [&seen](const XmlAttribute& attribute, FrameworkElement& element, BuildContext& context) {
            context.Defer(BuildStage::kConnections, [&, &at = *element.parent()] {
              const FrameworkElement* const beacon = SearchElement(PathIn(attribute, at), context);
              if (beacon != nullptr) seen.push_back(element.path() + " at " + beacon->path());
            });
          }};
}

TEST(AddedWords, AreUnderstoodLikeBuiltInOnes) {
  Workshop workshop;
  std::vector<std::string> seen;
  workshop.tags.AddTag(BeaconTag());
  workshop.tags.AddAttribute(NearAttribute(seen));
  ASSERT_TRUE(workshop.Build(R"(<application name="demo">
    <module name="a" type="test/sink" near="tower"/>
    <beacon name="tower" strength="7"/>
    <beacon name="hut"/>
  </application>)"))
      << workshop.diagnostics.ToString();
  EXPECT_EQ(workshop.Get<Beacon>("/demo/tower").strength(), 7u);
  EXPECT_EQ(workshop.Get<Beacon>("/demo/hut").strength(), 1u);
  EXPECT_THAT(seen, ::testing::ElementsAre("/demo/a at /demo/tower"));
}

TEST(AddedWords, AreCheckedLikeBuiltInOnes) {
  Workshop workshop;
  std::vector<std::string> seen;
  workshop.tags.AddTag(BeaconTag());
  workshop.tags.AddAttribute(NearAttribute(seen));
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <module name="a" type="test/sink" near="towre"/>
  <module name="b" type="test/sink" near=""/>
  <beacon name="hill" strength="high"/>
  <beacon name="tower"/>
  <beacon name="tower"/>
  <beacn/>
</application>)"),
            "app.xml:2:43: error: /demo: there is no 'towre' in /demo; did you mean 'tower'?\n"
            "app.xml:3:43: error: /demo/b: a path must not be empty\n"
            "app.xml:4:33: error: /demo/hill: 'high' is not a count; write 0, 1, 2 …\n"
            "app.xml:6:3: error: /demo: there is already an element called 'tower'; choose another "
            "name\n"
            "app.xml:7:3: error: /demo: no <beacn> may stand in <application>; did you mean "
            "'beacon'?\n");
}

TEST(AddedWords, ThatThrowAreErrorsAtTheTag) {
  Workshop workshop;
  workshop.tags.AddTag({.name = "now", .parents = {"application"}, .handle = [](const TagUse&) -> FrameworkElement* {
                          throw std::runtime_error("out of paper");
                        }});
  workshop.tags.AddTag(
      {.name = "later", .parents = {"application"}, .handle = [](const TagUse& use) -> FrameworkElement* {
         use.context.Defer(BuildStage::kChecks, [] { throw 5; });
         return &use.parent;
       }});
  workshop.tags.AddAttribute({.tag = "module",
                              .rule = {.name = "colour"},
                              .handle = [](const XmlAttribute&, FrameworkElement&, BuildContext&) {
                                throw std::runtime_error("no such colour");
                              }});
  EXPECT_EQ(workshop.Errors(R"(<application name="demo">
  <now/>
  <later/>
  <module name="a" type="test/sink" colour="red"/>
</application>)"),
            "app.xml:2:3: error: /demo: <now> failed: out of paper\n"
            "app.xml:3:3: error: /demo: <later> failed: exception of type int\n"
            "app.xml:4:37: error: /demo/a: colour=\"red\" failed: no such colour\n");
  EXPECT_TRUE(workshop.runtime.root().children().empty());
}

TEST(AddedWords, MustBeNew) {
  XmlTagRegistry tags = ApplicationTags();
  tags.set_plugin("beacons");
  tags.AddTag(BeaconTag());
  EXPECT_THROW(tags.AddTag(BeaconTag()), ElementError);
  EXPECT_THROW(tags.AddTag({.name = "module", .parents = {"group"}, .handle = {}}), ElementError);
  EXPECT_THROW(tags.AddAttribute({.tag = "module", .rule = {.name = "name"}, .handle = {}}), ElementError);
  EXPECT_THROW(tags.AddAttribute({.tag = "modul", .rule = {.name = "x"}, .handle = {}}), ElementError);
}

TEST(AddedWords, GoWithARefusedPlugin) {
  XmlTagRegistry tags = ApplicationTags();
  std::vector<std::string> seen;
  tags.set_plugin("beacons");
  tags.AddTag(BeaconTag());
  tags.AddAttribute(NearAttribute(seen));
  tags.set_plugin("");
  (void)tags.SetAside("beacons");
  EXPECT_EQ(tags.FindTag("beacon"), nullptr);
  EXPECT_EQ(tags.AddedAttributes("module").size(), 3u) << "thread, config, tags";
  EXPECT_NE(tags.FindTag("module"), nullptr);
}

}  // namespace
}  // namespace runnel::testing
