// What code outside includes, inside: nothing else is included here.

#include <gmock/gmock.h>
#include <runnel/application.h>
#include <runnel/module.h>
#include <runnel/plugin.h>
#include <runnel/testing.h>
#include <runnel/types.h>

namespace runnel::test {
namespace {

struct Battery {
  double charge = 0;
};

[[maybe_unused]] void Describe(TypeBuilder<Battery>& type) {
  type.Name("TestBattery").Field("charge", &Battery::charge);
}

class Brake final : public Module {
 public:
  using Module::Module;

  Input<Twist2> wanted{this, "wanted"};
  Output<Twist2> twist{this, "twist"};
  Output<Battery> battery{this, "battery"};
  Parameter<double> factor{this, "factor", {.default_value = 0.5}};
  StaticParameter<FilePath> map{this, "map"};

 private:
  void Update() override {
    twist.Publish({.forward = factor.Get() * wanted.Get().forward});
    battery.Publish({.charge = 1});
  }
};

TEST(HeadersTest, HaveWhatAModuleIsWrittenWith) {
  ModuleRig<Brake> rig;
  rig.Feed(rig.module.wanted, Twist2{.forward = 1});
  EXPECT_THAT(rig, PublishesWithin(1, rig.module.twist, Twist2{.forward = 0.5}));
}

TEST(HeadersTest, HaveWhatAnApplicationIsRunWith) {
  const auto application = Application::Load("nowhere.xml");
  EXPECT_FALSE(application);
}

}  // namespace
}  // namespace runnel::test

RUNNEL_PLUGIN(headers, registry) { registry.Add<runnel::test::Brake>("headers/brake", "brakes"); }
