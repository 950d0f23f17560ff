#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/element/configurable.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/plugin/module_type_name.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/parameters/parameter.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_text.h"
#include "tests/plugins/structure/random_model.h"

namespace runnel::test {

// What random applications are made of.
class RandomSource final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};
  Parameter<int> step{this, "step", {.default_value = 1, .bounds = {0, 9}}};

 private:
  void Update() override { out.Publish(value_ += step.Get()); }
  int value_ = 0;
};

class RandomPass final : public Module {
 public:
  using Module::Module;
  Input<int> in{this, "in"};
  Output<int> out{this, "out"};
  Parameter<int> step{this, "step", {.default_value = 1, .bounds = {0, 9}}};

 private:
  void Update() override {
    // Not all that waits: what is connected to itself would never come to an end.
    if (const auto value = in.Take()) out.Publish(*value + step.Get());
  }
};

class RandomWords final : public Module {
 public:
  using Module::Module;
  Output<std::string> out{this, "out"};

 private:
  void Update() override { out.Publish(std::string("a text that needs a buffer of its own")); }
};

template <typename M>
ModuleType RandomTypeCalled(std::string name) {
  return {std::move(name), "", "test",
          [](const Placement& placement) { return std::unique_ptr<FrameworkElement>(std::make_unique<M>(placement)); }};
}

inline std::string ThreadOf(const FrameworkElement& element) {
  const ThreadContainer* const thread = OwnThread(element);
  return thread != nullptr ? thread->name() : "";
}

// The live structure in the words of the model.
inline std::string LiveText(Runtime& runtime, const std::string& top) {
  const std::lock_guard lock(runtime.structure_mutex());
  std::set<std::string> lines;
  (*runtime.root().Find(top))->Visit([&](FrameworkElement& each) {
    if (const auto* const port = dynamic_cast<const Port*>(&each)) {
      if (port->is_proxy()) lines.insert(StructureModel::PortLine(port->path()));
      for (const Connection& edge : port->outgoing()) {
        lines.insert(port->path() + " > " + edge.to->path() + " " + std::to_string(edge.options.queue));
        EXPECT_EQ(std::ranges::count(edge.to->incoming(), port), 1);
      }
    } else if (each.kind() == ElementKind::kGroup) {
      lines.insert(StructureModel::GroupLine(each.path(), ThreadOf(each)));
    } else if (each.kind() == ElementKind::kModule) {
      const auto step = each.Find("parameter/step");
      const std::string value = step ? dynamic_cast<Configurable&>(**step).ToText() : "";
      lines.insert(StructureModel::ModuleLine(each.path(), FindModuleType(each), value, ThreadOf(each)));
    }
  });
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

// Change sets in one group, of which about half can be carried out.
class RandomChanges {
 public:
  RandomChanges(std::uint32_t seed, std::string top) : random_(seed), top_(std::move(top)) {}

  ChangeSet Next(const StructureModel& model) {
    ChangeSet changes;
    for (std::size_t left = Below(2) == 0 ? 1 : 1 + Below(4); left > 0; --left) {
      changes.push_back(One(model));
    }
    return changes;
  }

 private:
  std::size_t Below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  std::string OneOf(const std::vector<std::string>& texts) {
    return texts.empty() ? top_ + "/none" : texts[Below(texts.size())];
  }
  // Of something that is there, or, now and then, of something that is not or is made by this set.
  std::string Path(const StructureModel& model) { return Below(8) == 0 ? NewPath(model) : OneOf(model.Paths()); }
  std::string NewPath(const StructureModel& model) {
    const std::string parent = Below(3) == 0 ? OneOf(model.Paths()) : top_;
    return parent + "/" + OneOf({"a", "b", "c", "d", "e", "f"});
  }
  std::string PortPath(const StructureModel& model) {
    return Below(8) == 0 ? NewPath(model) + OneOf({"/output/out", "/input/in", ""}) : OneOf(model.PortPaths());
  }
  std::string Type() { return OneOf({"random/source", "random/pass", "random/pass", "random/words", "random/none"}); }
  std::vector<Setting> Settings() {
    if (Below(2) == 0) return {};
    return {{OneOf({"step", "step", "step", "stop"}), OneOf({"2", "5", "9", "10"})}};
  }
  Change One(const StructureModel& model) {
    switch (Below(14)) {
      case 0:
      case 1:
      case 2:
        return CreateModule{NewPath(model), Type(), Settings()};
      case 3:
        return CreateGroup{NewPath(model)};
      case 4:
        return CreatePort{NewPath(model), static_cast<Port::Direction>(Below(2)), Below(8) == 0 ? "nothing" : "int32"};
      case 5: {
        const std::string path = Path(model);
        return DeleteElement{path == top_ ? top_ + "/a" : path};
      }
      case 6:
      case 7:
      case 8:
        return ConnectPorts{PortPath(model), PortPath(model), {.queue = Below(2) * 3, .on_full = OnFull::kDropOldest}};
      case 9: {
        const auto edges = model.Edges();
        if (edges.empty()) return DisconnectPorts{PortPath(model), PortPath(model)};
        const auto& [from, to] = edges[Below(edges.size())];
        return DisconnectPorts{from, to};
      }
      case 10:
        return SetParameter{Path(model) + "/parameter/step", OneOf({"0", "7", "11", "x"})};
      case 11:
      case 12:
        return ReplaceModule{Path(model), Type(), Settings(), Below(3) * 5};
      default:
        return AssignToThread{Path(model), OneOf({"one", "two", "", "three"})};
    }
  }

  std::mt19937 random_;
  const std::string top_;
};

inline std::string TextOf(const ChangeSet& changes) {
  std::string text;
  for (const Change& each : changes) text += ChangeText(each) + "\n";
  return text;
}

inline void RegisterRandomTypes(ModuleRegistry& modules) {
  (void)TypeOf<int>();
  ASSERT_TRUE(modules.Add(RandomTypeCalled<RandomSource>("random/source")));
  ASSERT_TRUE(modules.Add(RandomTypeCalled<RandomPass>("random/pass")));
  ASSERT_TRUE(modules.Add(RandomTypeCalled<RandomWords>("random/words")));
}

}  // namespace runnel::test
