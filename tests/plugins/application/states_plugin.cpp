// What the table of states is tried with (state_table_test.cpp).

#include "core/module/group.h"
#include "core/module/group_parameter.h"
#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/proxy_port.h"
#include "plugins/parameters/parameter.h"

namespace runnel::test {

class StatesSource final : public Module {
 public:
  using Module::Module;
  Output<double> out{this, "out", {.pullable = true, .unit = "m/s"}};

 private:
  void Update() override { out.Publish(++cycles_); }
  double cycles_ = 0;
};

class StatesFilter : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in", {.unit = "m/s"}};
  Input<double> queued{this, "queued", {.unit = "m/s"}};
  Input<double> pulled{this, "pulled", {.unit = "m/s"}};
  Input<double> late{this, "late", {.unit = "m/s"}};
  Input<double> taken{this, "taken", {.unit = "m/s"}};
  Input<int> rounded{this, "rounded", {.unit = "m/s"}};
  Output<double> out{this, "out"};
  Parameter<double> gain{this, "gain", {.default_value = 1.0}};

 private:
  void Update() override { out.Publish(in.Get() * gain.Get()); }
};

/// Has the same ports.
class StatesOtherFilter final : public StatesFilter {
 public:
  using StatesFilter::StatesFilter;
};

/// Has none of them.
class StatesEmpty final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override {}
};

/// Has them in its interface.
class StatesBox final : public Group {
 public:
  using Group::Group;
  Result<void> Construct() override {
    auto& part = runtime().Create<StatesFilter>(*this, "part");
    runtime().Create<GroupParameter>(*this, "gain", std::vector<std::string>{"part/gain"}, "");
    for (Port* each : std::initializer_list<Port*>{&part.in, &part.queued, &part.pulled, &part.late, &part.taken,
                                                   &part.rounded, &part.out}) {
      const bool is_input = each->direction() == Port::Direction::kInput;
      auto& port = runtime().Create<ProxyPort>(*this, each->name(), each->direction(), each->type());
      if (auto tied = is_input ? Port::Connect(port, *each) : Port::Connect(*each, port); !tied) return tied;
    }
    return {};
  }
};

}  // namespace runnel::test

RUNNEL_PLUGIN(states, registry) {
  registry.Add<runnel::test::StatesSource>("states/source", "publishes");
  registry.Add<runnel::test::StatesFilter>("states/filter", "has what is set set at it");
  registry.Add<runnel::test::StatesOtherFilter>("states/other", "the same once more");
  registry.Add<runnel::test::StatesBox>("states/box", "the same as a composite");
  registry.Add<runnel::test::StatesEmpty>("states/empty", "has no ports");
}
