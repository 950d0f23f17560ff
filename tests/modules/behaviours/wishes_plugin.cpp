// Behaviours that fail where the test wants it, in a library that can be loaded anew (network_faults_test.cpp).

#include <optional>

#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/behaviours/behaviour.h"
#include "plugins/behaviours/behaviour_group.h"
#include "plugins/parameters/parameter.h"

extern "C" void InjectionPointForPlugins();  // of the program

namespace runnel::test {

/// A kept state.
struct Wishes {
  int count = 0;
};
inline void Describe(TypeBuilder<Wishes>& type) { type.Name("test::Wishes").Field("count", &Wishes::count); }

/// Wants a number, with all of its activation, and remembers how often it has.
class Wisher : public Behaviour {
 public:
  explicit Wisher(const Placement& placement) : Behaviour(placement) {
    KeepState(wishes_);
    InjectionPointForPlugins();
  }
  ControlOutput<double> wish{this, "wish"};
  DerivedActivity half{this, "half"};
  Parameter<double> wanted{this, "wanted", {.default_value = 1.0}};
  Output<int> count{this, "count"};

 protected:
  Result<void> Construct() override {
    auto made = Behaviour::Construct();
    InjectionPointForPlugins();
    return made;
  }
  Result<void> Prepare() override {
    auto prepared = Behaviour::Prepare();
    InjectionPointForPlugins();
    return prepared;
  }
  std::optional<Outcome> Behave(double activation) override {
    wish.Set(wanted.Get());
    half.Set(activation / 2);
    InjectionPointForPlugins();
    count.Publish(++wishes_.count);
    return Outcome{activation, 0.5};
  }

 private:
  Wishes wishes_;
};

/// Another one, which has more outputs.
class OtherWisher final : public Wisher {
 public:
  using Wisher::Wisher;
  ControlOutput<double> further{this, "further"};
};

/// Behaves badly in each cycle, once it has set its outputs.
class BadWisher final : public Wisher {
 public:
  using Wisher::Wisher;

 private:
  std::optional<Outcome> Behave(double activation) override {
    (void)Wisher::Behave(activation);
    return Outcome{2.0, 0.5};
  }
};

/// Several that are one to others.
class Crowd final : public BehaviourGroup {
 public:
  using BehaviourGroup::BehaviourGroup;
  Wisher first{{*this, "first"}};
  Wisher second{{*this, "second"}};

 private:
  Result<void> Construct() override {
    if (auto set = first.inhibitions.Set(2); !set) return set;
    if (auto made = Characterise(first); !made) return made;
    return Port::Connect(first.activity, second.stimulation);
  }
};

/// What the robot drives by.
class Wheels final : public Module {
 public:
  using Module::Module;
  Input<double> speed{this, "speed"};
  Output<double> turned{this, "turned"};

 private:
  void Update() override { turned.Publish(speed.Get()); }
};

}  // namespace runnel::test

RUNNEL_PLUGIN(wishes, registry) {
  using namespace runnel::test;
  runnel::RegisterMetaSignals();
  InjectionPointForPlugins();
  registry.Add<Wisher>("wishes/wisher", "wants a number");
  registry.Add<OtherWisher>("wishes/other", "wants two");
  registry.Add<BadWisher>("wishes/bad", "is more active than it may be");
  registry.Add<Crowd>("wishes/crowd", "several that are one to others");
  registry.Add<Wheels>("wishes/wheels", "what the robot drives by");
}
