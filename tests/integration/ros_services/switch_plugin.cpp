// A plugin for tests: a lamp with services, and a button that calls one.

#include <stdexcept>

#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/output.h"
#include "plugins/parameters/parameter.h"
#include "plugins/services/client.h"
#include "plugins/services/service.h"

namespace runnel::test {

class Lamp final : public Module {
 public:
  using Module::Module;

  Output<bool> lit{this, "lit"};
  Parameter<bool> is_broken{this, "is_broken", {.default_value = false}};
  Parameter<double> level{
      this, "level", {.default_value = 1.0, .bounds = {0.0, 10.0}, .unit = "cd", .description = "how bright"}};
  StaticParameter<std::string> make{this, "make", {.default_value = "old"}};
  Service<std::string(bool)> set{this, "set", &Lamp::Set};
  Service<std::string()> warm{this, "warm", &Lamp::Warm};
  Service<void()> reset{this, "reset", &Lamp::Reset};

 private:
  Result<std::string> Set(const bool& on) {
    if (!on) return Error{.message = "it burns for ever"};
    lit.Publish(on);
    return std::string("it burns");
  }
  // By a thread of its own.
  Result<std::string> Warm(Activity& activity) {
    activity.Report(0.5, "warming");
    return std::string("it is warm");
  }
  void Reset() { lit.Publish(false); }
  void Update() override {
    if (is_broken.Get()) throw std::runtime_error("the wire is through");
  }
};

/// Calls once a second, and says what comes of it.
class Button final : public Module {
 public:
  using Module::Module;

  Client<std::string(bool)> set{this, "set", {.timeout = std::chrono::seconds(1)}};

 private:
  void Update() override {
    if (is_waiting_) return;
    const auto begun = set.Call([this](const CallOutcome<std::string>& outcome) { Say(outcome); }, true);
    is_waiting_ = begun == CallStatus::kPending;
  }
  void Say(const CallOutcome<std::string>& outcome) {
    is_waiting_ = false;
    if (outcome) {
      log().Info("answered: {}", *outcome);
    } else {
      log().Info("{}: {}", CallStatusName(outcome.status()), std::string(outcome.error()));
    }
  }

  bool is_waiting_ = false;
};

}  // namespace runnel::test

RUNNEL_PLUGIN(switches, registry) {
  using namespace runnel::test;
  registry.Add<Lamp>("switches/lamp", "burns");
  registry.Add<Button>("switches/button", "switches something on, again and again");
}
