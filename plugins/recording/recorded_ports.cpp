#include "plugins/recording/recorded_ports.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/module/executable.h"
#include "core/module/group.h"
#include "core/module/port_group.h"
#include "core/port/port.h"
#include "core/types/type_info.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/values/port_patterns.h"
#include "plugins/recording/recording_names.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel {

namespace {

// Stands for whatever published there; the player takes the place of its task.
class RecordedModule final : public FrameworkElement {
 public:
  explicit RecordedModule(const Placement& placement)
      : FrameworkElement(placement, ElementKind::kModule) {
    Annotate(std::make_unique<Executable>([this]() -> std::vector<Task> {
      return {{this, Phase::kUpdate, BoundCall::To<&RecordedModule::DoNothing>(*this), {}, {this}}};
    }));
  }
  void DoNothing() {}
};

// One port of each type that the modules of plugins have, by the name of the type.
class KnownTypes {
 public:
  explicit KnownTypes(const BuildTools& tools) {
    for (const std::string& plugin : tools.plugins.Available()) {
      // What cannot be loaded has its say where it is asked for.
      (void)tools.plugins.Load(plugin);
    }
    for (const ModuleType* type : tools.plugins.modules().All()) {
      const auto module = tools.plugins.modules().CreateSample(type->name, runtime_.root());
      if (!module) continue;
      (*module)->Visit([this](FrameworkElement& element) {
        const auto* const port = dynamic_cast<const Port*>(&element);
        if (port != nullptr && !port->is_proxy()) ports_.try_emplace(port->type().name(), port);
      });
    }
  }
  // nullptr if nobody has such a port.
  [[nodiscard]] std::unique_ptr<Port> MakeOutput(const std::string& type, FrameworkElement& parent,
                                                 const std::string& name) const {
    const auto found = ports_.find(type);
    return found == ports_.end() ? nullptr : found->second->MakeOutput(parent, name, {});
  }

 private:
  Runtime runtime_;
  std::map<std::string, const Port*> ports_;
};

using Parts = std::vector<std::string>;

// How many of the parts lead to the module that a port is of: all but the port and its group.
std::size_t ModuleDepth(const std::string& path, const Parts& parts) {
  return parts.size() - (PlainPortPath(path) == path ? 1 : 2);
}

// Puts ports where they were recorded, and around them what had them.
class RecordedTree {
 public:
  RecordedTree(const McapContents& contents, const KnownTypes& types, Runtime& runtime)
      : types_(types), runtime_(runtime) {
    for (const auto& [id, channel] : contents.channels) {
      const std::string path = PortOf(channel);
      Parts parts = PartsOf(path);
      if (parts.size() < 2 || IsView(channel)) continue;
      parts.resize(ModuleDepth(path, parts));
      modules_.insert(std::move(parts));
    }
  }

  // Throws ElementError where names are none, or are taken.
  Result<void> Add(const std::string& path, const std::string& type) {
    const Parts parts = PartsOf(path);
    if (parts.size() < 2) return Error{.message = "is no path of a port", .path = path};
    const std::size_t depth = ModuleDepth(path, parts);
    FrameworkElement* parent = &runtime_.root();
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      FrameworkElement* const known = parent->FindChild(parts[i]);
      parent =
          known != nullptr
              ? known
              : &Make(*parent, {parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i) + 1},
                      i >= depth);
    }
    auto port = types_.MakeOutput(type, *parent, parts.back());
    if (port == nullptr) {
      return Error{.message = "no plugin here has ports of type '" + type + "'",
                   .path = path,
                   .hint = "is RUNNEL_PLUGIN_PATH set to the folder of the plugin that has it?"};
    }
    runtime_.Adopt(std::unique_ptr<FrameworkElement>(std::move(port)));
    return {};
  }

 private:
  FrameworkElement& Make(FrameworkElement& parent, const Parts& parts, bool is_port_group) {
    if (is_port_group) return runtime_.Create<PortGroup>(parent, parts.back());
    if (modules_.contains(parts)) return runtime_.Create<RecordedModule>(parent, parts.back());
    return runtime_.Create<Group>(parent, parts.back());
  }

  const KnownTypes& types_;
  Runtime& runtime_;
  std::set<Parts> modules_;
};

}  // namespace

BuildOutcome BuildRecordedPorts(const std::string& file, const BuildTools& tools) {
  BuildOutcome outcome;
  const auto reader = McapReader::Open(file);
  if (!reader) {
    outcome.diagnostics.Add(reader.error());
    return outcome;
  }
  const KnownTypes types(tools);
  Runtime& runtime = tools.runtime;
  const McapContents& contents = (*reader)->contents();
  RecordedTree tree(contents, types, runtime);
  std::vector<Error> failures;
  for (const auto& [id, channel] : contents.channels) {
    if (IsView(channel)) continue;
    const auto schema = contents.schemas.find(channel.schema);
    const std::string type = schema != contents.schemas.end() ? schema->second.name : "";
    try {
      if (auto made = tree.Add(PortOf(channel), type); !made) {
        failures.push_back(made.error());
        continue;
      }
    } catch (const ElementError& error) {
      failures.push_back(error.error());
      continue;
    }
    outcome.application = runtime.root().FindChild(PartsOf(PortOf(channel)).front());
  }
  if (outcome.application == nullptr) {
    outcome.diagnostics.Add(
        failures.empty()
            ? Error{.message = "there are no ports in this recording", .position = {file}}
            : failures.front());
    return outcome;
  }
  for (Error& failure : failures) outcome.diagnostics.AddWarning(std::move(failure));
  // As fine as anybody can see.
  CreateThread(runtime, "player", {.period = std::chrono::milliseconds(5)});
  return outcome;
}

}  // namespace runnel
