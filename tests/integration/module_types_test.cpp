// The module types of all plugins of the tree: who may command a motion says of each input whether what comes there grows
// old, each that does has its time-out as a parameter, and each says in the same words why a value does not count.

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/configurable.h"
#include "core/element/runtime.h"
#include "core/log/log_sink.h"
#include "core/plugin/module_registry.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/input_base.h"
#include "core/port/port.h"
#include "core/port/port_stop.h"
#include "core/types/type_of.h"
#include "modules/types/pose.h"
#include "plugins/testing/module_rig.h"

namespace runnel::test {
namespace {

using testing::AnyOfArray;
using testing::Contains;
using testing::IsEmpty;

/// Of one module type, with the parameters that change which ports there are.
struct Sample {
  std::string name;
  std::unique_ptr<Runtime> runtime = std::make_unique<Runtime>();
  FrameworkElement* module = nullptr;
};

Configurable* FindParameter(const FrameworkElement& module, const std::string& name) {
  const auto found = module.Find("parameter/" + name);
  return found ? dynamic_cast<Configurable*>(*found) : nullptr;
}

// "in" of "in2".
std::string FamilyOf(const Port& input) {
  return input.name().substr(0, input.name().find_last_not_of("0123456789") + 1);
}

std::vector<Port*> PortsOf(const Sample& sample, Port::Direction direction) {
  std::vector<Port*> ports;
  sample.module->Visit([&](FrameworkElement& element) {
    auto* const port = dynamic_cast<Port*>(&element);
    if (port != nullptr && port->direction() == direction) ports.push_back(port);
  });
  return ports;
}

// Of a number a file may say that it is a velocity.
bool MayCommand(const Sample& sample) {
  for (const Port* each : PortsOf(sample, Port::Direction::kOutput)) {
    if (IsVelocity(each->type(), each->unit())) return true;
    if (&each->type() == &TypeOf<double>() && each->unit().empty()) return true;
  }
  return false;
}

struct ModuleTypes : testing::Test {
  ModuleTypes() {
    for (const std::string& plugin : plugins.Available()) {
      if (const auto loaded = plugins.Load(plugin); !loaded) ADD_FAILURE() << loaded.error().ToString();
    }
  }

  Sample Make(const std::string& type, const std::map<std::string, std::string>& parameters) const {
    Sample sample{.name = type};
    const auto made = plugins.modules().Create(type, sample.runtime->root(), "module");
    if (!made) {
      ADD_FAILURE() << made.error().ToString();
      return sample;
    }
    sample.module = *made;
    const std::lock_guard lock(sample.runtime->structure_mutex());
    for (const auto& [name, text] : parameters) {
      Configurable* const parameter = FindParameter(*sample.module, name);
      if (parameter == nullptr) continue;
      if (const auto set = parameter->SetFromText(text); !set) ADD_FAILURE() << set.error().ToString();
      sample.name += " " + name + "=" + text;
    }
    if (const auto ready = Runtime::Construct(*sample.module); !ready) ADD_FAILURE() << ready.error().ToString();
    return sample;
  }
  /// Of each type one with its ports as they are by default, and where a parameter changes these, one of velocities.
  std::vector<Sample> Samples() const {
    std::vector<Sample> samples;
    for (const ModuleType* type : plugins.modules().All()) {
      samples.push_back(Make(type->name, {}));
      if (samples.back().module == nullptr) samples.pop_back();
      if (samples.empty() || FindParameter(*samples.back().module, "type") == nullptr) continue;
      samples.push_back(Make(type->name, {{"type", "Twist2"}, {"inputs", "3"}, {"channels", "3"}}));
      samples.push_back(Make(type->name, {{"type", "double"}, {"unit", "m/s"}}));
    }
    return samples;
  }

  PluginManager plugins;
  Runtime other;
  Output<Twist2> makes_twists_known{other.root(), "twist"};
};

TEST_F(ModuleTypes, ThatCommandAMotionSayWhatGrowsOld) {
  std::vector<std::string> unsaid;
  std::size_t commanding = 0;
  for (const Sample& sample : Samples()) {
    if (!MayCommand(sample)) continue;
    ++commanding;
    for (const Port* each : PortsOf(sample, Port::Direction::kInput)) {
      const auto* const input = dynamic_cast<const InputBase*>(each);
      if (input != nullptr && input->ageing() == Ageing::kUnspecified)
        unsaid.push_back(sample.name + ": " + input->path());
    }
  }
  EXPECT_GT(commanding, 35u);
  EXPECT_THAT(unsaid, IsEmpty());
}

// Inputs that are numbered have one for all of them, or one each.
TEST_F(ModuleTypes, HaveATimeOutOfEachInputThatGrowsOld) {
  std::vector<std::string> missing;
  std::size_t inputs = 0;
  for (const Sample& sample : Samples()) {
    for (const Port* each : PortsOf(sample, Port::Direction::kInput)) {
      const auto* const input = dynamic_cast<const InputBase*>(each);
      if (input == nullptr || input->ageing() != Ageing::kTimesOut) continue;
      ++inputs;
      const FrameworkElement& module = *input->parent()->parent();
      const Configurable* timeout = FindParameter(module, input->name() + "_timeout");
      if (timeout == nullptr) timeout = FindParameter(module, FamilyOf(*input) + "_timeout");
      if (timeout == nullptr || timeout->info().unit != "s" || timeout->info().default_value == "0") {
        missing.push_back(sample.name + ": " + input->path());
      }
    }
  }
  EXPECT_GT(inputs, 50u);
  EXPECT_THAT(missing, IsEmpty());
}

/// What a module says in a second in which nothing comes to it.
std::vector<std::string> SaysAlone(const std::string& type) {
  std::vector<std::string> said;
  ModuleRig rig(type.c_str());
  if (type == "simulation/world") rig.Set("world", RUNNEL_XML "/worlds/rooms.xml");
  if (FindParameter(rig.module, "stimulation_mode") != nullptr) rig.Set("stimulation_mode", "enabled");
  const LogSink sink(rig.runtime, [&](const LogMessage& message) { said.push_back(message.text); });
  const auto fault = rig.RunUntilFault(20);
  EXPECT_FALSE(fault) << type << ": " << fault->message;
  FlushLog();
  return said;
}

// Those of a composite and of a component say it of their parts, and when an activity reads them.
TEST_F(ModuleTypes, SayInTheSameWordsWhatHasNotCome) {
  int asked = 0;
  for (const Sample& sample : Samples()) {
    if (sample.name.find(' ') != std::string::npos || sample.name == "behaviours/navigator" ||
        sample.name == "guide/guide")
      continue;
    std::vector<testing::Matcher<std::string>> words;
    for (const Port* each : PortsOf(sample, Port::Direction::kInput)) {
      const auto* const input = dynamic_cast<const InputBase*>(each);
      if (input == nullptr || input->ageing() != Ageing::kTimesOut) continue;
      words.emplace_back(input->name() + " has never come");
      words.emplace_back(FamilyOf(*input) + " has never come");
    }
    if (words.empty()) continue;
    ++asked;
    EXPECT_THAT(SaysAlone(sample.name), Contains(AnyOfArray(words))) << sample.name;
  }
  EXPECT_GT(asked, 20);
}

}  // namespace
}  // namespace runnel::test
