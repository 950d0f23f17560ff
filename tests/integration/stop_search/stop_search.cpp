#include "tests/integration/stop_search/stop_search.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/element/runtime.h"
#include "core/plugin/module_type_name.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/port_stop.h"
#include "core/types/text_format.h"
#include "modules/types/pose.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_tags/application_tags.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/parameters/configuration.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/change_text.h"
#include "plugins/structure/reload.h"
#include "plugins/structure/structure_editor.h"
#include "tests/integration/stop_search/expected_marks.h"

namespace runnel::test {

namespace {

class Search {
 public:
  Search(std::uint64_t seed, std::uint64_t steps) : random_(seed), steps_(steps) {
    plugins_.registry().Offer(tags_);
    Build();
  }

  StopSearchResult Run() {
    for (; result_.steps < steps_ && result_.violations.size() < 10; ++result_.steps) {
      DoSomething();
      Check();
      if (DrivingPorts().size() < 3) Build();  // too much has been deleted
    }
    result_.came_back += expected_.came_back;
    return std::move(result_);
  }

 private:
  using Action = std::pair<int, std::function<void()>>;  // how often, and what

  // Runs it again from its file, under STOP if it was under STOP.
  void Build() {
    history_.reset();
    editor_.reset();
    scheduler_.reset();
    runtime_.emplace();
    released_at_.reset();
    result_.came_back += std::exchange(expected_, {}).came_back;
    if (is_stopped_) runtime_->robot_stop().Press("the search");
    const auto folder = std::filesystem::path(RUNNEL_XML) / "apps";
    auto document = XmlDocument::Load((folder / "bug_demo.xml").string());
    if (!document) throw std::runtime_error(document.error().ToString());
    Configuration configuration;
    for (const std::string argument : {"picture=", "world=" RUNNEL_XML "/worlds/rooms.xml"}) {
      if (auto added = configuration.AddArgument(argument); !added) {
        throw std::runtime_error(added.error().ToString());
      }
    }
    const BuildOutcome built =
        BuildApplication(*document, folder, {*runtime_, plugins_, tags_, configuration}, BuildMode::kConstruct);
    if (built.application == nullptr) throw std::runtime_error(built.diagnostics.ToString());
    SchedulerOptions options = SchedulerOptionsOf(*built.application);
    options.speed = 0;
    scheduler_.emplace(*runtime_, options);
    editor_.emplace(*runtime_, plugins_.modules(), &*scheduler_);
    history_.emplace(*editor_);
    if (auto ready = MakeApplicationReady(*built.application); !ready) {
      throw std::runtime_error(ready.error().ToString());
    }
    for (Port* const port : Ports([](const Port& each) { return each.name() == "wheels" || each.name() == "twist"; }))
      (void)port->SetDriving(true);
    NoteMarks();
  }

  FrameworkElement* application() {
    const auto& children = runtime_->root().children();
    const auto group = std::ranges::find(children, ElementKind::kGroup, &FrameworkElement::kind);
    return group == children.end() ? nullptr : *group;
  }

  std::vector<Port*> Ports(const std::function<bool(const Port&)>& is_meant) {
    std::vector<Port*> ports;
    runtime_->root().Visit([&](FrameworkElement& element) {
      auto* const port = dynamic_cast<Port*>(&element);
      if (port != nullptr && is_meant(*port)) ports.push_back(port);
    });
    return ports;
  }
  ExpectedMarks::Paths Paths() {
    ExpectedMarks::Paths paths;
    for (const Port* const port : Ports([](const Port&) { return true; })) paths.insert(port->path());
    return paths;
  }
  // As they have to be, whatever the ports themselves say.
  std::vector<Port*> DrivingPorts() {
    return Ports([&](const Port& port) { return expected_.marked.contains(port.path()); });
  }
  void NoteMarks() {
    for (Port* const port : Ports([](const Port& port) { return port.is_driving(); }))
      expected_.marked.insert(port->path());
  }
  // What was marked or blocked and is still there has to be so still.
  void CheckMarks() {
    const auto check = [&](std::set<std::string>& paths, bool (Port::*is)() const noexcept, const char* what) {
      std::set<std::string> there;
      for (Port* const port : Ports([&](const Port& each) { return paths.contains(each.path()); })) {
        if ((port->*is)()) {
          there.insert(port->path());
        } else {
          Violate(port->path() + " has lost " + what);
        }
      }
      paths = std::move(there);
    };
    check(expected_.marked, &Port::is_driving, "its mark as driving");
    check(expected_.blocked, &Port::is_blocked, "its block");
    NoteMarks();  // copies
  }
  void Violate(const std::string& what) {
    result_.violations.push_back("step " + std::to_string(result_.steps) + ", after '" + last_ + "': " + what);
  }
  std::vector<FrameworkElement*> Parts() {
    std::vector<FrameworkElement*> parts;
    application()->Visit([&](FrameworkElement& element) {
      const bool is_part = element.kind() == ElementKind::kModule || element.kind() == ElementKind::kGroup;
      if (is_part && &element != application()) parts.push_back(&element);
    });
    return parts;
  }

  std::size_t Below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  template <typename T>
  T* OneOf(const std::vector<T*>& all) {
    return all.empty() ? nullptr : all[Below(all.size())];
  }

  void Change(const ChangeSet& changes, const std::string& from = "", const std::string& to = "") {
    last_ = ChangeText(changes.front());
    if (!history_->Apply(changes).is_done) {
      ++result_.refused;
      return;
    }
    expected_.Did(last_, from, to, Paths());
  }
  void Rename() {
    FrameworkElement* const part = OneOf(Parts());
    if (part == nullptr) return;
    const std::string from = part->path();
    const std::string name = "part" + std::to_string(++names_);
    Change({RenameElement{from, name}}, from, from.substr(0, from.rfind('/') + 1) + name);
  }
  void Undo() {
    last_ = "undo";
    if (!Follows(history_->NextUndo(), expected_.NextUndo())) return;
    const ChangeOutcome outcome = history_->Undo();
    if (outcome.is_done || outcome.is_refused) expected_.Undid(outcome.is_done, Paths());
  }
  void Redo() {
    last_ = "redo";
    if (!Follows(history_->NextRedo(), expected_.NextRedo())) return;
    const ChangeOutcome outcome = history_->Redo();
    if (outcome.is_done || outcome.is_refused) expected_.Redid(outcome.is_done, Paths());
  }
  // Whether there is one.
  bool Follows(const std::optional<std::string>& next, const std::optional<std::string>& expected) {
    if (next != expected) throw std::logic_error("the search has not followed the history");
    if (next) last_ += " of " + *next;
    return next.has_value();
  }
  void SetByHand(Port::Setter setter) {
    Port* const port = OneOf(DrivingPorts());
    if (port == nullptr) return;
    last_ = "set " + port->path();
    (void)port->PublishByHand(
        [&](void* value) -> Result<void> {
          if (&port->type() == &TypeOf<Twist2>()) *static_cast<Twist2*>(value) = {0.3, 0.1};
          if (&port->type() == &TypeOf<WheelSpeeds>()) *static_cast<WheelSpeeds*>(value) = {4, 5};
          return {};
        },
        setter);
  }
  void ReleaseByHand(Port::Setter setter) {
    last_ = "release";
    if (Port* const port = OneOf(DrivingPorts())) port->Release(setter);
  }
  void CutOrMend() {
    Port* const to = OneOf(DrivingPorts());
    if (to == nullptr) return;
    if (!to->incoming().empty()) {
      Change({DisconnectPorts{to->incoming().front()->path(), to->path()}});
      return;
    }
    Port* const from = OneOf(Ports(
        [&](const Port& port) { return &port.type() == &to->type() && port.direction() == Port::Direction::kOutput; }));
    if (from) Change({ConnectPorts{from->path(), to->path()}});
  }
  void RunCycles(std::size_t cycles) {
    last_ += ", then " + std::to_string(cycles) + " cycles";
    for (std::size_t i = 0; i < cycles; ++i) {
      if (!scheduler_->Step()) throw std::runtime_error("the scheduler has ended");
      Check();
    }
  }

  void DoSomething() {
    const std::vector<Action> actions = {
        {4, [&] { Press(); }},
        {5, [&] { Release(); }},
        {2,
         [&] {
           Port* const port = OneOf(DrivingPorts());
           if (port != nullptr && port->Block()) expected_.blocked.insert(port->path());
         }},
        {2,
         [&] {
           Port* const port = OneOf(DrivingPorts());
           if (port == nullptr) return;
           (void)port->Unblock();
           expected_.blocked.erase(port->path());
         }},
        {4, [&] { SetByHand(Port::Setter::kPerson); }},
        {2, [&] { SetByHand(Port::Setter::kRule); }},
        {3, [&] { ReleaseByHand(Port::Setter::kPerson); }},
        {2, [&] { ReleaseByHand(Port::Setter::kRule); }},
        {2, [&] { CutOrMend(); }},
        {3, [&] { Rename(); }},
        {1,
         [&] {
           if (auto* part = OneOf(Parts())) Change({DeleteElement{part->path()}});
         }},
        {1,
         [&] {
           if (auto* part = OneOf(Parts())) Change({CopyElement{part->path()}});
         }},
        {3, [&] { MakeAnew(); }},
        {1, [&] { Reload(); }},
        {1,
         [&] {
           last_ = "run again";
           Build();
         }},
        {5, [&] { Undo(); }},
        {2, [&] { Redo(); }},
        {14, [&] { RunCycles(1 + Below(4)); }},
    };
    if (result_.steps < actions.size()) return actions[result_.steps].second();  // each of them once
    int sum = 0;
    for (const auto& [weight, act] : actions) sum += weight;
    auto place = static_cast<int>(Below(static_cast<std::size_t>(sum)));
    for (const auto& [weight, act] : actions) {
      if ((place -= weight) < 0) return act();
    }
  }
  void MakeAnew() {
    FrameworkElement* const part = OneOf(Parts());
    if (part == nullptr || part->kind() != ElementKind::kModule) return;
    static const char* const kPlanners[] = {"bug1", "bug2", "tangent_bug", "dist_bug"};
    const std::string type = FindModuleType(*part);
    const bool is_planner = type.starts_with("planning/");
    Change({ReplaceModule{part->path(), is_planner ? std::string("planning/") + kPlanners[Below(4)] : type}});
  }
  void Reload() {
    static const char* const kPlugins[] = {"motion", "planning", "simulation", "adaptors"};
    const std::string plugin = kPlugins[Below(4)];
    last_ = "reload " + plugin;
    if (!ReloadPlugin(plugins_, *editor_, *runtime_, plugin)) ++result_.refused;
    ++result_.reloads;
  }
  void Press() {
    last_ = "press";
    if (!runtime_->robot_stop().Press("the search")) return;
    is_stopped_ = true;
    ++result_.presses;
  }
  void Release() {
    last_ = "release of the robot";
    if (!runtime_->robot_stop().Release("the search")) return;
    is_stopped_ = false;
    released_at_ = runtime_->clock().Now();
  }

  static bool IsSafe(const Port& port, const void* value) {
    return ToText(port.type(), value) == ToText(port.type(), port.stop()->safe_value().get());
  }
  void Check() {
    CheckMarks();
    for (Port* const port : DrivingPorts()) {
      for (Port* const reader : port->Sinks()) {
        if (&reader->type() == &port->type()) Check(*port, *reader);
      }
    }
  }
  void Check(const Port& port, const Port& reader) {
    ++result_.checks;
    if (is_stopped_) ++result_.checks_in_force;
    reader.VisitLatest([&](const void* value, ValueTimes times) {
      if (IsSafe(port, value)) return;
      ++result_.moving;
      const bool is_late_enough =
          !released_at_ || (times.timestamp > *released_at_ && times.publication_time > *released_at_);
      if (!is_stopped_ && !expected_.blocked.contains(port.path()) && is_late_enough) return;
      Violate(reader.path() + " is " + ToText(port.type(), value));
    });
  }

  std::mt19937_64 random_;
  const std::uint64_t steps_;
  StopSearchResult result_;
  std::string last_;
  std::uint64_t names_ = 0;
  bool is_stopped_ = false;  // as it has to be, whatever the robot says
  std::optional<Time> released_at_;
  ExpectedMarks expected_;

  XmlTagRegistry tags_ = ApplicationTags();
  PluginManager plugins_;
  std::optional<Runtime> runtime_;
  std::optional<Scheduler> scheduler_;
  std::optional<StructureEditor> editor_;
  std::optional<ChangeHistory> history_;
};

}  // namespace

StopSearchResult SearchForWaysAroundStop(std::uint64_t seed, std::uint64_t steps) { return Search(seed, steps).Run(); }

}  // namespace runnel::test
