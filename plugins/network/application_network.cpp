// Attaches the network to an application that has a <network>.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/clock.h"
#include "core/element/element_path.h"
#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/plugin/plugin_entry.h"
#include "plugins/application/application.h"
#include "plugins/application/extension_registry.h"
#include "plugins/command_service/application_log.h"
#include "plugins/command_service/command_service.h"
#include "plugins/command_service/extension_texts.h"
#include "plugins/control/element_listing.h"
#include "plugins/network/application_commands.h"
#include "plugins/network/network_engines.h"
#include "plugins/network/network_link.h"
#include "plugins/network/xml_network_tags.h"
#include "plugins/ros_messages/node_messages.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/wire_shared_memory/shared_memory_wire.h"

namespace runnel {

namespace {

// So long a thread counts as late.
constexpr auto kLate = std::chrono::seconds(5);

// What supervision says of an input in the log, behind its path.
constexpr std::string_view kSilent = ": nothing new for ", kFresh = ": values come again";

// The path that ends there; a place in a file may stand in front.
std::string PathBefore(const std::string& text, std::size_t end) {
  const std::size_t begin = text.rfind(' ', end) + 1;  // npos + 1 is 0
  return text.substr(begin, end - begin);
}

/// How an application is, for /diagnostics: modules that have failed, inputs to which nothing new comes (<on_stale>),
/// threads whose cycles end too late.
///
/// Ownership:  the application must outlive it. Copies begin anew.
/// Threads:    one at a time; takes the structure lock.
class ApplicationHealth {
 public:
  explicit ApplicationHealth(Application& application) : application_(&application) {}

  [[nodiscard]] std::vector<RosDiagnosticStatus> operator()() {
    ReadLog();
    const std::string& name = application_->name();
    std::vector<RosDiagnosticStatus> all;
    const auto add = [&](RosHealth level, const std::string& of, const std::string& message) {
      all.push_back({.level = level, .name = name + ": " + of, .message = message, .hardware_id = name, .values = {}});
    };
    if (failed_.empty() && silent_.empty()) {
      add(RosHealth::kOk, "modules", "no fault");
    } else {
      add(failed_.empty() ? RosHealth::kWarning : RosHealth::kError, "modules",
          std::to_string(failed_.size()) + " failed, " + std::to_string(silent_.size()) + " inputs without news");
    }
    for (const auto& [path, why] : failed_) add(RosHealth::kError, path, why);
    for (const auto& [path, why] : silent_) add(RosHealth::kStale, path, why);
    AddThreads(all);
    return all;
  }

 private:
  struct Overruns {
    std::uint64_t count = 0;
    Time since{};  // when there was one, on the application's clock
  };

  void ReadLog() {
    const auto news = application_->log().ReadEntries(next_in_log_, ApplicationLog::kMostEntries);
    next_in_log_ = news.next;
    for (const ApplicationLog::Entry& entry : news.entries) {
      if (!entry.module.empty() && entry.cause.empty()) failed_.erase(entry.module);
      if (!entry.module.empty() && !entry.cause.empty()) failed_[entry.module] = entry.cause;
      if (const std::size_t place = entry.text.find(kSilent); place != std::string::npos) {
        silent_[PathBefore(entry.text, place)] = entry.text.substr(place + 2);
      } else if (const std::size_t end = entry.text.find(kFresh); end != std::string::npos) {
        silent_.erase(PathBefore(entry.text, end));
      }
    }
  }

  void AddThreads(std::vector<RosDiagnosticStatus>& all) {
    Runtime& runtime = application_->runtime();
    const Time now = runtime.clock().Now();
    const std::lock_guard lock(runtime.structure_mutex());
    runtime.root().VisitAll<const ThreadContainer>([&](const ThreadContainer& thread) {
      const CycleStatistics cycles = thread.statistics();
      Overruns& known = overruns_[thread.path()];
      if (cycles.overruns > known.count) known = {cycles.overruns, now};
      const bool is_late = known.count > 0 && now - known.since < kLate;
      all.push_back({.level = is_late ? RosHealth::kWarning : RosHealth::kOk,
                     .name = application_->name() + ": thread " + thread.name(),
                     .message = is_late ? "cycles end too late" : "in time",
                     .hardware_id = application_->name(),
                     .values = {{"cycles", std::to_string(cycles.cycles)},
                                {"overruns", std::to_string(cycles.overruns)},
                                {"period", fmt::format("{:.6f} s", ToSeconds(cycles.period_mean))},
                                {"longest execution", fmt::format("{:.6f} s", ToSeconds(cycles.execution_max))}}});
    });
  }

  Application* application_;
  std::uint64_t next_in_log_ = 0;
  std::map<std::string, std::string> failed_;  // modules, and why
  std::map<std::string, std::string> silent_;  // inputs, and what was said
  std::map<std::string, Overruns> overruns_;   // by thread
};

class ApplicationNetwork final : public ApplicationExtension {
 public:
  Result<void> Prepare(FrameworkElement& application, SchedulerOptions& options) override {
    is_simulated_ = options.clock == SchedulerOptions::ClockKind::kSimulated;
    NetworkElement* const element = NetworkElement::FindIn(application);
    if (element == nullptr) return {};
    const bool follows_clock = element->options().ros && element->options().ros->follows_clock;
    if (follows_clock && (!options.follows_outside_clock || !options.clock_port.empty())) {
      return Error{.message = "the time of /clock is that of nobody here",
                   .position = element->options().position,
                   .hint = "say <clock type=\"outside\"/>, or leave clock=\"follow\" out"};
    }
    if (!is_simulated_ || follows_clock) return {};  // whoever follows others has no runs that can be repeated
    element->set_simulated();
    const auto refuse = [](const std::string& path, const SourcePosition& position) {
      return Error{.message = "with simulated time, values that come when they like make runs that cannot be repeated",
                   .path = path,
                   .position = position,
                   .hint = "say live=\"true\" if that is meant"};
    };
    for (const auto& each : element->takes()) {
      if (!each.options.is_live) return refuse(each.output->path(), each.options.position);
    }
    const LateConnections* const late = LateConnections::FindIn(application.runtime());
    const auto is_distant = [&](const LateConnection& each) {
      return IsDistantPath(each.from) && IsAtOrBelow(each.to, application.path());
    };
    if (!element->options().is_live && late != nullptr && std::ranges::any_of(late->all(), is_distant)) {
      return refuse(element->path(), element->options().position);
    }
    for (const auto& each : element->service_takes()) {
      if (!each.options.is_live) return refuse(each.output->path(), each.options.position);
    }
    return {};
  }

  Result<void> Begin(Application& application, Diagnostics&) override {
    NetworkElement* const element = NetworkElement::FindIn(application.element());
    if (element == nullptr) return {};
    if (std::ranges::any_of(application.extensions(), [](const auto& each) { return each->Replays(); })) {
      LeaveOut(application);
      if (!element->options().ros || !element->options().ros->follows_clock) return {};
      return Error{.message = "the time of /clock is not told in a replay, which leaves the network out",
                   .position = element->options().position,
                   .hint = "replay it with <clock type=\"simulated\" speed=\"1\"/>, and without clock=\"follow\""};
    }
    engine_ = FindEngine(application, *element);
    if (engine_ == nullptr)
      return Error{.message = "the network has no engine", .position = element->options().position};
    FrameworkElement& group = application.element();
    RosHooks hooks{
        .set_parameters = [&application](const auto& changes) { return SetParameters(application, changes); },
        .health = ApplicationHealth(application),
        .set_time = [&application](Time time) { return application.SetTime(time); },
        .clock_lead = [&application] { return application.scheduler().pace().outside_lead(); },
        .is_stop_kept = application.service().application().hooks.is_stop_kept,
        .check_stop = [&application] { return CheckThatAllStops(application.runtime(), &application.scheduler()); }};
    auto link = NetworkLink::Start(
        group, *element, *engine_, is_simulated_, [&group] { return ListElements(group, {}); }, std::move(hooks));
    if (!link) return link.error();
    link_ = std::move(*link);
    commands_ = ApplicationCommands::Start(*link_, *element, application.service());
    application_ = &application;
    const std::lock_guard lock(application.runtime().structure_mutex());
    auto texts = std::make_unique<ExtensionTexts>();
    texts->texts["network"] = [this](const std::string&, auto&) -> Result<std::optional<std::string>> {
      return std::optional(link_->Text());
    };
    texts->texts["network_picture"] = [this](const std::string&, auto&) -> Result<std::optional<std::string>> {
      return std::optional(link_->Picture());
    };
    texts->texts["command"] = [this](const std::string& change, auto& asking) {
      return commands_->Ask(change, asking);
    };
    texts->texts["structure"] = [this](const std::string& path, auto&) { return link_->StructureOf(path); };
    group.Annotate(std::move(texts));
    return {};
  }

  [[nodiscard]] std::string StartText() const override {
    return is_left_out_ ? std::string("the network is left out: ") + kLeftOut + "\n" : "";
  }

  void End() noexcept override {
    if (application_ == nullptr) return;
    {
      const std::lock_guard lock(application_->runtime().structure_mutex());
      if (auto* const texts = application_->element().FindAnnotation<ExtensionTexts>()) texts->texts.clear();
    }
    commands_.reset();
    link_.reset();
  }

 private:
  // Commands would drive who is there now, and what it sends would come between what is played.
  void LeaveOut(Application& application) {
    is_left_out_ = true;
    application_ = &application;
    const std::lock_guard lock(application.runtime().structure_mutex());
    auto texts = std::make_unique<ExtensionTexts>();
    for (const char* const name : {"network", "command", "structure"}) {
      texts->texts[name] = [](const std::string&, auto&) -> Result<std::optional<std::string>> {
        return Error{.message = "the network is left out", .hint = kLeftOut};
      };
    }
    application.element().Annotate(std::move(texts));
  }
  // Between two cycles, as any change: it can be undone.
  static Result<void> SetParameters(Application& application, const std::vector<ParameterChange>& wanted) {
    ChangeSet changes;
    for (const ParameterChange& each : wanted) changes.push_back(SetParameter{.path = each.path, .value = each.value});
    return application.Apply(changes).ToResult();
  }
  static std::shared_ptr<WireEngine> FindEngine(Application& application, const NetworkElement& element) {
    const std::lock_guard lock(application.runtime().structure_mutex());  // as for all plugins
    auto found = FindWireEngine(element.options().engine, application.plugins());
    return found ? MakeSharedMemoryWire(std::move(*found)) : nullptr;
  }

  static constexpr const char* kLeftOut = "values come from a recording";
  bool is_simulated_ = false;
  bool is_left_out_ = false;
  Application* application_ = nullptr;
  std::shared_ptr<WireEngine> engine_;
  std::unique_ptr<NetworkLink> link_;
  std::unique_ptr<ApplicationCommands> commands_;
};

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(network, registry) {
  if (auto* const tags = registry.Find<runnel::XmlTagRegistry>()) {
    runnel::AddNetworkTags(*tags);
    runnel::AddSecurityTag(*tags);
  }
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add([](const runnel::ExtensionArguments&) -> runnel::Result<runnel::Extensions> {
      return runnel::Extensions{std::make_shared<runnel::ApplicationNetwork>()};
    });
  }
}
