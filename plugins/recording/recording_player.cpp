#include "plugins/recording/recording_player.h"

#include <algorithm>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/file_notes.h"
#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/module/run_monitor.h"
#include "core/paths/path_search.h"
#include "core/port/probe_port.h"
#include "core/types/type_info.h"
#include "plugins/recording/recording_names.h"
#include "plugins/values/foxglove_channel.h"

namespace runnel {

namespace {

/// Below which the outputs of a player are; no part of the application.
class PlayerElement final : public FrameworkElement {
 public:
  explicit PlayerElement(const Placement& placement) : FrameworkElement(placement) {
    Annotate(std::make_unique<NotSaved>());
  }
};

// The module that publishes there; nullptr if nothing with tasks does.
FrameworkElement* PublisherOf(const Port& port) {
  FrameworkElement* at = port.parent();
  while (at != nullptr && at->FindAnnotation<Executable>() == nullptr) at = at->parent();
  return at;
}

bool Writes(const Task& task, const Port& port) {
  return std::ranges::any_of(
      task.writes, [&](const FrameworkElement* group) { return group != nullptr && port.IsAtOrBelow(*group); });
}

// The port at a recorded path; or, if the application is called otherwise now, in its place.
Port* FindPort(Runtime& runtime, const std::string& path) {
  const PathSearch search(runtime);
  if (const auto found = search.FindPort(path, PathKind::kOutput)) return *found;
  const auto found = search.FindPort(ShortPortPath(path), PathKind::kOutput);
  return found ? *found : nullptr;
}

}  // namespace

/// One recorded port, with the output that plays it: an own one, where the module goes on publishing at
/// the original.
struct Player::PlayedPort {
  Port* original;
  std::uint16_t channel;
  std::unique_ptr<Port> output;
  std::string path;  // of the original
  ChangeSet sources = {};

  [[nodiscard]] Port& publisher() const noexcept { return output ? *output : *original; }
};

/// What runs in the place of a module's task.
class Player::PlayedTask {
 public:
  PlayedTask(Player& player, std::optional<BoundCall> original, std::vector<PlayedPort*> ports)
      : player_(player), original_(original), ports_(std::move(ports)) {}
  void Run() {
    if (original_) (*original_)();
    player_.Publish(ports_);
  }

 private:
  Player& player_;
  const std::optional<BoundCall> original_;
  const std::vector<PlayedPort*> ports_;
};

Result<std::unique_ptr<Player>> Player::Prepare(Runtime& runtime, std::unique_ptr<McapReader> reader,
                                                const PlayerOptions& options) {
  const auto patterns = PortPatterns::Make(options.ports);
  if (!patterns) return patterns.error();
  const std::string file = reader->file();
  if (reader->contents().statistics.messages == 0) {
    return Error{.message = "there are no values in this recording", .position = {file}};
  }
  const McapStatistics& all = reader->contents().statistics;
  const Duration whole(static_cast<std::int64_t>(all.end - all.start));
  if (options.from && *options.from > whole) {
    return Error{.message = "the recording ends before that: it has " + std::to_string(ToSeconds(whole)) + " s",
                 .position = {file}};
  }
  if (options.from && options.to && *options.to < *options.from) {
    return Error{.message = "the end of what is to be played is before its beginning", .position = {file}};
  }
  std::unique_ptr<Player> player(
      new Player(runtime, std::make_unique<PlayedValues>(std::move(reader), options.from, options.to, options.loops)));
  const ChangeScope changes(runtime);
  if (auto found = player->FindPorts(*patterns); !found) return found.error().WithPosition(file);
  if (auto found = player->FindCalls(*patterns); !found) return found.error();
  player->WrapTasks();
  runtime.root().FindOrAnnotate<SwitchedByRules>().all.push_back([self = std::weak_ptr(player->self_)] {
    const auto there = self.lock();
    return there != nullptr ? std::vector<ChangeSet>{(*there)->Connections()} : std::vector<ChangeSet>();
  });
  player->calls_.WrapTasks([&](const FrameworkElement& module) { return !player->resting_.contains(&module); });
  if (auto ready = runtime.MakeReady(*player->element_); !ready) return ready.error();
  return player;
}

Player::Player(Runtime& runtime, std::unique_ptr<PlayedValues> values)
    : runtime_(runtime), values_(std::move(values)) {}

Player::~Player() {
  played_.clear();
  if (element_ != nullptr) (void)runtime_.Delete(*element_);
}

Result<void> Player::FindPorts(const PortPatterns& patterns) {
  element_ = &runtime_.Create<PlayerElement>(runtime_.root(), FreeName(runtime_.root(), "player"));
  std::vector<std::string> recorded;
  for (const auto& [id, channel] : values_->reader().contents().channels) {
    if (IsView(channel)) continue;
    const std::string path = PortOf(channel);
    recorded.push_back(PlainPortPath(path));
    recorded.push_back(ShortPortPath(path));
    if (!patterns.Fit(path)) continue;
    Port* const port = FindPort(runtime_, path);
    if (port == nullptr) {
      missing_.push_back(path);
      continue;
    }
    if (auto good = CheckType(*port, channel); !good) return good;
    played_.push_back(std::make_unique<PlayedPort>(PlayedPort{port, id, nullptr, port->path()}));
    values_->Want(id);
  }
  for (const std::string& name : patterns.Names()) {
    const auto one = PortPatterns::Make({name});
    const auto fits = [&](const auto& each) { return one->Fit(each); };
    if (std::ranges::any_of(missing_, fits)) {
      return Error{.message = "the application has no port '" + name + "' to play"};
    }
    if (std::ranges::none_of(played_, [&](const auto& each) {
          return one->Fit(PortOf(values_->reader().contents().channels.at(each->channel)));
        })) {
      return Error{.message = "the recording has no port '" + name + "'", .hint = NearestNameHint(name, recorded)};
    }
  }
  if (!played_.empty()) return {};
  if (!missing_.empty()) {
    return Error{.message = "the application has none of the ports that were recorded",
                 .hint = "recorded is, for example, " + missing_.front()};
  }
  std::string wanted;
  for (const std::string& pattern : patterns.texts()) wanted += " '" + pattern + "'";
  return Error{.message = "the recording has no port that fits" + wanted,
               .hint = NearestNameHint(patterns.texts().empty() ? "" : patterns.texts().front(), recorded)};
}

// Of services whose records are not played themselves.
Result<void> Player::FindCalls(const PortPatterns& patterns) {
  for (const auto& [id, channel] : values_->reader().contents().channels) {
    if (IsView(channel) || patterns.Fit(PortOf(channel))) continue;
    Port* const port = FindPort(runtime_, PortOf(channel));
    if (port != nullptr && CheckType(*port, channel)) (void)calls_.Add(*port, id);
  }
  return calls_.Read(values_->reader(), values_->start(), values_->end());
}

Result<void> Player::CheckType(const Port& port, const McapChannel& channel) const {
  const auto& schemas = values_->reader().contents().schemas;
  const auto schema = schemas.find(channel.schema);
  const auto refuse = [&](const std::string& why) {
    return Error{.message = "what was recorded cannot be played here: " + why, .path = port.path()};
  };
  if (channel.message_encoding != kMessageEncoding || schema == schemas.end() ||
      schema->second.encoding != kSchemaEncoding) {
    return refuse("it is not JSON with a JSON schema");
  }
  if (schema->second.name != port.type().name()) {
    return refuse("it is of type " + schema->second.name + ", the port takes " + port.type().name());
  }
  if (port.type().Make() == nullptr) return refuse("only its module can make such values");
  if (schema->second.data != ChannelsFor(port.type(), "", WholeValues()).front().schema) {
    return refuse("the type " + port.type().name() + " was another one when it was recorded");
  }
  return {};
}

// Takes the place of ports, and tasks the place of tasks: first those of each module, then the player's
// own for what no task publishes.
void Player::WrapTasks() {
  std::vector<std::pair<FrameworkElement*, std::vector<PlayedPort*>>> by_module;
  for (const auto& each : played_) {
    const bool is_output = !each->original->is_proxy() && each->original->direction() == Port::Direction::kOutput;
    FrameworkElement* const module = is_output ? PublisherOf(*each->original) : nullptr;
    const auto known = std::ranges::find(by_module, module, [](const auto& it) { return it.first; });
    auto& ports =
        known != by_module.end() ? known->second : by_module.emplace_back(module, std::vector<PlayedPort*>()).second;
    ports.push_back(each.get());
  }
  for (auto& [module, ports] : by_module) {
    WrapTasksOf(module != nullptr ? *module : *element_, ports);
  }
}

FrameworkElement& Player::TakePlaces(const std::vector<PlayedPort*>& ports) {
  auto& group = runtime_.Create<PlayerElement>(*element_, FreeName(*element_, "played"));
  for (PlayedPort* each : ports) {
    Port& port = *each->original;
    each->output = port.MakeOutput(group, FreeName(group, port.name()), {.unit = port.unit()});
    if (!port.is_proxy() && port.direction() == Port::Direction::kOutput) {
      each->output->TakeOver(port);
      continue;
    }
    const std::vector<Port*> sources = port.incoming();
    for (Port* source : sources) {
      each->sources.push_back(ConnectPorts{source->path(), each->path, source->ConnectionTo(port)->options});
      (void)Port::Disconnect(*source, port);
    }
    (void)Port::Connect(*each->output, port);
  }
  return group;
}

ChangeSet Player::Connections() const {
  ChangeSet all;
  // Those that are deleted by now are not visited.
  runtime_.root().VisitAll<const Port>([&](const Port& port) {
    for (const auto& each : played_) {
      if (each->original != &port || !each->output) continue;
      all.insert(all.end(), each->sources.begin(), each->sources.end());
      for (const Connection& edge : each->output->outgoing()) {
        if (edge.to != &port) all.push_back(ConnectPorts{port.path(), edge.to->path(), edge.options});
      }
    }
  });
  return all;
}

// Whether somebody, recorders aside, reads what the task publishes and is not played.
bool Player::IsReadUnplayed(const Task& task) const {
  bool is_read = false;
  for (const FrameworkElement* group : task.writes) {
    if (group == nullptr) continue;
    const_cast<FrameworkElement*>(group)->Visit([&](FrameworkElement& each) {
      const auto* const port = dynamic_cast<const Port*>(&each);
      const auto plays = [&](const auto& played) { return played->original == port; };
      if (port == nullptr || std::ranges::any_of(played_, plays)) return;
      for (const Port* sink : port->Sinks()) {
        if (dynamic_cast<const ProbePort*>(sink) == nullptr) is_read = true;
      }
    });
  }
  return is_read;
}

void Player::WrapTasksOf(FrameworkElement& module, const std::vector<PlayedPort*>& ports) {
  const auto* const executable = module.FindAnnotation<Executable>();
  std::vector<Task> tasks = executable != nullptr ? executable->tasks() : std::vector<Task>();
  if (&module == element_) tasks = {{element_, Phase::kSense, BoundCall::To<&Player::DoNothing>(*this), {}, {}}};
  for (Task& task : tasks) {
    std::vector<PlayedPort*> of_task;
    for (PlayedPort* each : ports) {
      if (&module == element_ || Writes(task, *each->original)) of_task.push_back(each);
    }
    if (of_task.empty()) continue;
    const bool is_own = &module == element_;
    const bool runs = !is_own && (module.FindAnnotation<RunMonitor>() != nullptr || IsReadUnplayed(task));
    if (runs || is_own) task.writes.push_back(&TakePlaces(of_task));
    if (!runs) resting_.insert(&module);
    tasks_.push_back(
        std::make_unique<PlayedTask>(*this, runs ? std::optional(task.run) : std::nullopt, std::move(of_task)));
    task.run = BoundCall::To<&PlayedTask::Run>(*tasks_.back());
  }
  module.Annotate(std::make_unique<Executable>([tasks] { return tasks; }));
  if (!resting_.contains(&module)) return;
  // Tasks of its own that other threads run publish there, too.
  module.VisitAll<Module>([&](Module& each) {
    if (&each != &module) each.Annotate(std::make_unique<Executable>([] { return std::vector<Task>(); }));
  });
}

void Player::Publish(const std::vector<PlayedPort*>& ports) {
  const Cycle* const cycle = CurrentCycle();
  const Time now = cycle != nullptr ? cycle->now : runtime_.clock().Now();
  for (PlayedPort* each : ports) {
    while (auto value = values_->Take(each->channel, now)) {
      const CycleScope at({value->time, cycle != nullptr ? cycle->period : Duration::zero()});
      Port& output = each->publisher();  // the original may have been deleted, if that is another one
      const auto published = output.PublishFilled(
          [&](void* filled) { return SetFromMessage(output.type(), value->json, filled); }, value->timestamp);
      if (published) {
        published_.fetch_add(1, std::memory_order_relaxed);
        continue;
      }
      Error error = published.error().WithContext("the value recorded at " + std::to_string(ToSeconds(value->time)) +
                                                  " s cannot be played");
      error.path = each->path;
      return values_->Fail(std::move(error));
    }
  }
}

}  // namespace runnel
