// <driving>: ports by which something moves.

#include <gmock/gmock.h>

#include "core/port/port_stop.h"
#include "plugins/structure/change_history.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

/// Moves as fast as it is told to.
class Motor final : public Module {
 public:
  using Module::Module;
  Input<double> speed{this, "speed", {.unit = "m/s"}};
  Input<double> angle{this, "angle", {.unit = "rad"}};

 private:
  void Update() override {}
};

/// Says no unit.
class Wheel final : public Module {
 public:
  using Module::Module;
  Input<double> angle{this, "angle"};

 private:
  void Update() override {}
};

class Driving : public ::testing::Test {
 protected:
  Driving() { shop_.Add<Motor>("test/motor"); }

  void Load(const std::string& text) {
    WriteAll(folder_ / "app.xml", text);
    application_ = shop_.Load(folder_ / "app.xml");
    ASSERT_NE(application_, nullptr);
  }
  std::string Text() { return shop_.Text(*application_, folder_.path()); }
  Port& At(const std::string& path) { return shop_.Get<Port>(path); }
  void Must(const ChangeSet& changes) {
    StructureEditor editor(shop_.runtime, shop_.plugins.modules(), nullptr);
    const ChangeOutcome outcome = editor.Apply(changes);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }

  TestFolder folder_;
  SavingWorkshop shop_;
  FrameworkElement* application_ = nullptr;
};

const char* const kDrivingText = R"(<application name="demo">
  <group name="g">
    <module name="motor" type="test/motor"/>
    <driving port="motor/speed"/>
    <driving  port="motor/angle" safe="0.5" brake="0.3 s" command="position"/> <!-- folded -->
  </group>
  <module name="source" type="test/source"/>
  <driving port="source/value" safe="1" command="effort"/>
</application>
)";

double SafeOf(const Port& port) { return *static_cast<const double*>(port.stop()->safe_value().get()); }

TEST_F(Driving, MarksInputsAndOutputs) {
  Load(kDrivingText);
  EXPECT_TRUE(At("/demo/g/motor/input/speed").is_driving());
  EXPECT_EQ(SafeOf(At("/demo/g/motor/input/speed")), 0.0);
  EXPECT_EQ(SafeOf(At("/demo/g/motor/input/angle")), 0.5);
  EXPECT_EQ(At("/demo/g/motor/input/angle").stop()->brake(), std::chrono::milliseconds(300));
  EXPECT_EQ(At("/demo/g/motor/input/speed").stop()->brake(), Duration{});
  EXPECT_EQ(SafeOf(At("/demo/source/output/value")), 1.0);
  EXPECT_EQ(At("/demo/source/output/value").stop()->command(), DrivingKind::kEffort);
  EXPECT_EQ(At("/demo/g/motor/input/speed").stop()->command(), DrivingKind::kVelocity);
  EXPECT_EQ(At("/demo/g/motor/input/angle").stop()->command(), DrivingKind::kPosition);
  EXPECT_FALSE(At("/demo/source/output/label").is_driving());
  EXPECT_EQ(Text(), kDrivingText);
}

TEST_F(Driving, NeedsASafeValueThatIsOne) {
  EXPECT_THAT(
      shop_.Errors("<application name='a'>\n<module name='m' type='test/motor'/>\n"
                   "<driving port='m/angle'/>\n<driving port='m/speed' safe='fast'/>\n<driving port='m/sped'/>\n"
                   "</application>"),
      ::testing::AllOf(
          HasSubstr("app.xml:3:1: error: /a/m/input/angle: something moves by it, and it has no safe value"),
          HasSubstr("add safe=\"…\""), HasSubstr("app.xml:4:"), HasSubstr("did you mean 'speed'?")));
}

TEST_F(Driving, SaysOfANumberWithoutAUnitWhatItIs) {
  EXPECT_THAT(
      shop_.Errors("<application name='a'>\n<module name='s' type='test/source'/>\n"
                   "<driving port='s/value' safe='0'/>\n</application>"),
      ::testing::AllOf(HasSubstr("app.xml:3:1: error: /a/s/output/value: something moves by it, and neither a unit"),
                       HasSubstr("add command=\"velocity\"")));
  EXPECT_THAT(shop_.Errors("<application name='a'>\n<module name='s' type='test/source'/>\n"
                           "<driving port='s/value' safe='0' command='speed'/>\n</application>"),
              ::testing::AllOf(HasSubstr("app.xml:3:"), HasSubstr("velocity")));
}

// As far as the module that is there now does not say it.
TEST_F(Driving, IsSavedWithWhatItIsWhenAnotherModuleKnowsNoUnit) {
  shop_.Add<Wheel>("test/wheel");
  Load(
      "<application name=\"demo\">\n  <module name=\"m\" type=\"test/motor\"/>\n"
      "  <driving port=\"m/angle\" safe=\"0.5\"/>\n</application>\n");
  Must({ReplaceModule{"/demo/m", "test/wheel"}});
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("<driving port=\"m/angle\" safe=\"0.5\" command=\"position\"/>"));
  SavingWorkshop other;
  other.Add<Wheel>("test/wheel");
  WriteAll(folder_ / "again.xml", text);
  ASSERT_NE(other.Load(folder_ / "again.xml"), nullptr);
}

TEST_F(Driving, BrakesOnlyWhereThereAreValuesOnTheWay) {
  EXPECT_THAT(shop_.Errors("<application name='a'>\n<module name='s' type='test/source'/>\n"
                           "<driving port='s/label' safe='stand' brake='1 s'/>\n"
                           "<driving port='s/value' safe='0' brake='soon' command='effort'/>\n"
                           "</application>"),
              ::testing::AllOf(HasSubstr("app.xml:3:1: error: /a/s/output/label: cannot brake"),
                               HasSubstr("leave out how long it brakes"), HasSubstr("app.xml:4:")));
}

TEST_F(Driving, GoesWithAnotherName) {
  Load(kDrivingText);
  Must({RenameElement{"/demo/g/motor", "wheel"}});
  EXPECT_TRUE(At("/demo/g/wheel/input/angle").is_driving());
  const std::string text = Text();
  EXPECT_THAT(
      text,
      HasSubstr("<driving  port=\"wheel/angle\" safe=\"0.5\" brake=\"0.3 s\" command=\"position\"/> <!-- folded -->"));
  EXPECT_THAT(text, HasSubstr("<driving port=\"wheel/speed\"/>"));
}

TEST_F(Driving, GoesWithItsModuleAndIsSavedOfACopy) {
  Load(kDrivingText);
  Must({CopyElement{"/demo/g/motor", "second"}, DeleteElement{"/demo/g/motor"}});
  const std::string text = Text();
  EXPECT_THAT(text, ::testing::Not(HasSubstr("port=\"motor")));
  EXPECT_THAT(text,
              HasSubstr("<driving port=\"g/second/input/angle\" safe=\"0.5\" brake=\"300ms\" command=\"position\"/>"));
  SavingWorkshop other;
  other.Add<Motor>("test/motor");
  WriteAll(folder_ / "again.xml", text);
  ASSERT_NE(other.Load(folder_ / "again.xml"), nullptr);
  EXPECT_EQ(SafeOf(other.Get<Port>("/demo/g/second/input/angle")), 0.5);
  EXPECT_EQ(other.Get<Port>("/demo/g/second/input/angle").stop()->brake(), std::chrono::milliseconds(300));
  EXPECT_TRUE(other.Get<Port>("/demo/g/second/input/speed").is_driving());
}

}  // namespace
}  // namespace runnel::testing
