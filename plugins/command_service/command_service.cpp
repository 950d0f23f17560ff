#include "plugins/command_service/command_service.h"

#include <algorithm>
#include <new>
#include <type_traits>
#include <variant>

#include "core/base/argument_text.h"
#include "core/element/try_structure_lock.h"
#include "core/plugin/module_type_name.h"
#include "core/port/driving_ports.h"
#include "core/types/duration_text.h"
#include "plugins/command_service/change_task.h"
#include "plugins/command_service/request_table.h"
#include "plugins/command_service/save_place.h"
#include "plugins/structure/change_history.h"

namespace runnel {

void OperatorWatch::Begin(Duration timeout) {
  timeout_.store(timeout.count(), std::memory_order_relaxed);
  Hear("", Now());
  if (watched_clock_ != nullptr) return;
  lookout_.Ask();
  changes_ = stop_.signal()->Listen([this] { lookout_.Ask(); });
}

void OperatorWatch::Hear(std::string_view name, Time at) {
  if (timeout() == Duration::zero()) return;
  const std::lock_guard lock(mutex_);
  if (at <= heard_ || at > Now()) return;
  heard_ = at;
  last_ = name;
}

std::optional<Time> OperatorWatch::Look() {
  std::string why = "<operators>";
  {
    const std::lock_guard lock(mutex_);
    const Time due = heard_ + timeout();
    if (Now() < due) return due;
    try {
      why += ": none of them has been heard for " + DurationText(timeout()) + ", " +
             (last_.empty() ? "nor before" : "the last one was " + last_);
    } catch (const std::bad_alloc&) {  // it is pressed with fewer words
    }
  }
  stop_.Press(why);
  return {};
}

namespace {
constexpr Duration kBlockPatience = std::chrono::milliseconds(5);

Error UnreachedError(const std::pair<std::string, std::string>& port_and_why) {
  return {.message = "cannot be reached: " + port_and_why.second,
          .path = port_and_why.first,
          .hint = "what moves by it keeps its last command, and has to come to rest by its own time-out"};
}

// Writes into the log what others than clients change: those have their changes logged as they wrote them.
class StructureRecorder final : public ElementListener {
 public:
  StructureRecorder(Runtime& runtime, ApplicationLog& log) : runtime_(runtime), log_(log) {
    runtime_.AddListener(*this);
  }
  ~StructureRecorder() override { runtime_.RemoveListener(*this); }
  StructureRecorder(const StructureRecorder&) = delete;
  StructureRecorder& operator=(const StructureRecorder&) = delete;

  void OnReady(FrameworkElement& element) override {
    Add([&] {
      const std::string type = FindModuleType(element);
      return "put in " + element.path() + (type.empty() ? "" : " (" + type + ")");
    });
  }
  void OnDeleted(FrameworkElement& element) override {
    Add([&] { return "took out " + element.path(); });
  }
  void OnConnected(FrameworkElement& from, FrameworkElement& to) override {
    Add([&] { return "connected " + from.path() + " to " + to.path(); });
  }
  void OnDisconnected(FrameworkElement& from, FrameworkElement& to) override {
    Add([&] { return "disconnected " + from.path() + " from " + to.path(); });
  }

 private:
  template <typename Words>
  void Add(const Words& words) noexcept {
    try {
      if (!CommandWorker::IsThisThread()) log_.Add(ApplicationLog::Kind::kChange, words());
    } catch (const std::bad_alloc&) {  // what has been done is done, whether it is in the log or not
    }
  }

  Runtime& runtime_;
  ApplicationLog& log_;
};

using Hook = std::function<Result<std::string>(const std::string&)>;

CommandAnswer AnswerOf(Result<std::string> done) {
  return done ? CommandAnswer::Done(std::move(*done)) : CommandAnswer::Failed(done.error());
}

CommandAnswer Call(const Hook& hook, const std::string& argument, const char* what) {
  if (hook) return AnswerOf(hook(argument));
  return CommandAnswer::Refused({.message = std::string("the program that runs this application cannot ") + what});
}

}  // namespace

CommandService::CommandService(ServedApplication application)
    : application_(std::move(application)),
      recorder_(std::make_unique<StructureRecorder>(application_.runtime, application_.log)),
      hand_settings_(application_.runtime, worker_, application_.log),
      stop_(application_.runtime.robot_stop().signal()->Listen([this] {
        const auto state = application_.runtime.robot_stop().state();
        application_.log.Add(ApplicationLog::Kind::kWarning,
                             (state.in_force ? "STOP is in force, pressed by " : "STOP is released by ") + state.by);
      })),
      operators_(application_.runtime.robot_stop()) {}

CommandAnswer PendingCommand::Take() {
  if (task_->failure()) return CommandAnswer::Failed(*task_->failure());
  return std::move(*answer_);
}

// Nothing can fail once the task is posted: it would be carried out, and nobody be told.
std::unique_ptr<PendingCommand> CommandService::Begin(CommandRequest request, TaskGroup& tasks,
                                                      std::function<void()> on_done, RobotStop::AsOf as_of) {
  // Before anything that may fail.
  const auto* const stop = std::get_if<RobotStopRequest>(&request);
  const bool has_pressed = stop != nullptr && stop->is_pressed && application_.runtime.robot_stop().Press(stop->by);
  auto pending = std::make_unique<PendingCommand>();
  if (!LetsMove(request)) {
    as_of = {};
  } else if (!as_of.requests) {
    as_of = application_.runtime.robot_stop().AsOfNow(as_of.asked);
  }
  auto* const publish = std::get_if<PublishRequest>(&request);
  if (publish != nullptr && !publish->received) publish->received = hand_settings_.Now();
  const std::shared_ptr<CommandAnswer>& answer = pending->answer_;
  std::optional<CommandAnswer> at_once;
  if (stop != nullptr) at_once = Do(*stop, as_of, has_pressed);
  // A block is the STOP of one port: it waits for the worker only where it would wait for the structure lock, too.
  if (const auto* const block = std::get_if<BlockRequest>(&request)) {
    if (const auto lock = TryStructureLock(application_.runtime, kBlockPatience)) at_once = Do(*block);
  }
  if (at_once) {
    *answer = std::move(*at_once);
    pending->task_ = tasks.Done(std::move(on_done));
    return pending;
  }
  TaskStep step = std::visit(
      [&](auto& each) -> TaskStep {
        using Request = std::remove_reference_t<decltype(each)>;
        if constexpr (std::is_same_v<Request, ChangeRequest>) {
          return ChangeSteps(std::move(each), application_, answer, as_of);
        } else {
          if constexpr (std::is_same_v<Request, RestartRequest>) {
            if (!each.path.empty()) return ChangeSteps({}, application_, answer, as_of, std::move(each.path));
          }
          return [this, each, answer, as_of]() -> std::optional<Duration> {
            if (const auto known = application_.runtime.robot_stop().CheckIsKnown(as_of); !known) {
              *answer = CommandAnswer::Refused(known.error());
            } else if constexpr (requires { Do(each, as_of); }) {
              *answer = Do(each, as_of);
            } else {
              *answer = Do(each);
            }
            return {};
          };
        }
      },
      request);
  pending->task_ = tasks.PostSteps(std::move(step), std::move(on_done));
  return pending;
}

CommandAnswer CommandService::Do(const SaveRequest& request) const {
  std::string file = request.file;
  if (request.is_confined && !file.empty()) {
    const auto place = SavePlace(request.application_file, file);
    if (!place) return CommandAnswer::Refused(place.error());
    file = *place;
  }
  if (!request.overwrites && !file.empty() && application_.hooks.find_overwritten) {
    SaveRequest placed = request;
    placed.file = file;
    if (auto lost = application_.hooks.find_overwritten(placed)) {
      return CommandAnswer::Asks(std::move(*lost), "overwrite");
    }
  }
  if (request.is_configuration) {
    return Call(application_.hooks.save_configuration, file, "save its configuration");
  }
  return Call(application_.hooks.save, file, "save it");
}

CommandAnswer CommandService::Do(const ReloadRequest& request) const {
  return Call(application_.hooks.reload, request.plugin, "load plugins anew");
}

CommandAnswer CommandService::End(const char* name, const char* what,
                                  const std::function<Result<std::string>()>& end) const {
  if (!end) return Call({}, {}, what);
  application_.log.Add(ApplicationLog::Kind::kChange, name);
  return AnswerOf(end());
}

std::optional<StopReach> FindStopReach(Runtime& runtime, const Scheduler* scheduler) {
  const auto lock = TryStructureLock(runtime, std::chrono::milliseconds(20));
  if (!lock) return {};
  StopReach reach{.drives = FindWhatDrives(runtime).value_or(""), .unreached = {}};
  runtime.root().VisitAll<const Port>([&](const Port& port) {
    if (!port.is_driving()) return;
    reach.brake = std::max(reach.brake, port.stop()->brake());
    if (port.is_set_by_hand(Port::Setter::kRule)) reach.at_rest += (reach.at_rest.empty() ? "" : ", ") + port.path();
    const std::string why = scheduler != nullptr ? scheduler->WhyUnreached(port) : "";
    if (!why.empty()) reach.unreached.emplace_back(port.path(), why);
  });
  return reach;
}

Result<void> CheckThatAllStops(Runtime& runtime, const Scheduler* scheduler) {
  const auto reach = FindStopReach(runtime, scheduler);
  if (!reach)
    return Error{
        .message =
            "STOP is in force, but nobody can tell whether it reaches all of it while the structure is being changed"};
  std::string left;
  for (const auto& each : reach->unreached) left += (left.empty() ? "" : "; ") + UnreachedError(each).ToString();
  if (reach->drives.empty()) left = NothingDrives().ToString();
  if (left.empty()) return {};
  return Error{.message = "STOP is in force, but " + left};
}

CommandAnswer CommandService::Do(const RobotStopRequest& request, const RobotStop::AsOf& as_of,
                                 bool has_pressed) const {
  RobotStop& stop = application_.runtime.robot_stop();
  CommandAnswer answer;
  if (request.is_pressed) {
    const char* const since = has_pressed ? "" : " already";
    answer = CommandAnswer::Done(std::string("STOP is in force") + since + "; 'runnel release' ends it");
  } else {
    const std::string pressed_by = stop.state().by;
    if (const auto done = stop.Release(request.by, as_of); !done) return CommandAnswer::Refused(done.error());
    answer = CommandAnswer::Done("released the STOP that " + pressed_by + " had pressed");
  }
  if (application_.hooks.is_stop_kept && !application_.hooks.is_stop_kept()) {
    answer.text += "; the file by which the next process knows of it is not written yet";
  }
  const auto reach = FindStopReach(application_.runtime, application_.scheduler);
  if (!reach) {
    answer.text +=
        "; what drives cannot be told while the structure is being changed, nor whether STOP reaches all of it";
    return answer;
  }
  if (!reach->drives.empty()) answer.text += "; what drives: " + reach->drives;
  if (!request.is_pressed) return answer;
  for (const auto& each : reach->unreached) answer.diagnostics.AddWarning(UnreachedError(each));
  answer.leaves_some = !reach->unreached.empty();
  answer.stops_nothing = reach->drives.empty();
  if (answer.stops_nothing) answer.diagnostics.AddWarning(NothingDrives());
  return answer;
}

CommandAnswer CommandService::Do(const BlockRequest& request) {
  const auto blocked = hand_settings_.Block(request);
  if (!blocked) return CommandAnswer::Refused(blocked.error());
  application_.log.Add(ApplicationLog::Kind::kChange, "block " + *blocked);
  return CommandAnswer::Done(*blocked + " is blocked: it has its safe value; 'runnel release " + *blocked +
                             "' ends that");
}

CommandAnswer CommandService::Do(const PauseRequest& request) const {
  if (!application_.hooks.set_paused) return Call({}, {}, "pause its modules");
  const std::string what = (request.is_paused ? "paused " : "resumed ") + request.path;
  const auto done = application_.hooks.set_paused(request.path, request.is_paused);
  if (!done) return CommandAnswer::Refused(done.error());
  application_.log.Add(ApplicationLog::Kind::kChange, what);
  CommandAnswer answer = CommandAnswer::Done(what);
  const std::lock_guard lock(application_.runtime.structure_mutex());
  if (!request.is_paused) return answer;
  const StopReach reach = FindStopReach(application_.runtime, application_.scheduler).value();
  for (const auto& each : reach.unreached) answer.diagnostics.AddWarning(UnreachedError(each));
  if (!reach.at_rest.empty()) answer.text += "; driving ports with the safe value of supervision now: " + reach.at_rest;
  return answer;
}

// Who drives says so many times a second, which is told once.
CommandAnswer CommandService::Do(const PublishRequest& request, const RobotStop::AsOf& as_of) {
  const auto set = hand_settings_.Publish(request, as_of);
  if (!set) return CommandAnswer::Refused(set.error());
  const std::string& port = set->port;
  if (!set->goes_on) {
    std::string text = "publish " + port + " " + internal::AsArgument(request.value);
    if (request.deadline) text += " --deadline " + DurationText(*request.deadline);
    application_.log.Add(ApplicationLog::Kind::kChange, std::move(text));
  }
  const std::string ends = "'runnel release " + port + "' ends that";
  if (request.deadline) {
    return CommandAnswer::Done(port + " is set by hand for " + DurationText(*request.deadline) + ", then at rest; " +
                               ends);
  }
  return CommandAnswer::Done(port + " is set by hand; " + ends);
}

CommandAnswer CommandService::Do(const ReleaseRequest& request, const RobotStop::AsOf& as_of) {
  const auto released = ReleasePort(application_.runtime, request.port, as_of);
  if (!released) return CommandAnswer::Refused(released.error());
  application_.log.Add(ApplicationLog::Kind::kChange, "release " + *released);
  return CommandAnswer::Done("released " + *released);
}

CommandAnswer CommandService::TakeHistoryStep(bool goes_back, const RobotStop::AsOf& as_of) const {
  if (application_.history == nullptr) return Call({}, {}, "undo changes");
  ChangeHistory& history = *application_.history;
  const auto label = goes_back ? history.NextUndo() : history.NextRedo();
  std::string client = goes_back ? history.UndoClient() : history.RedoClient();
  std::string what;
  if (label) what = (goes_back ? "undone: " : "redone: ") + *label;
  std::string entry = what;
  CommandAnswer answer;
  ChangeOutcome outcome = goes_back ? history.Undo(as_of) : history.Redo(as_of);
  answer.diagnostics = std::move(outcome.diagnostics);
  if (!outcome) answer.outcome = CommandAnswer::Outcome::kRefused;
  if (!label) return answer;
  application_.log.Add(ApplicationLog::Kind::kChange, answer ? std::move(entry) : "could not be " + what);
  if (!answer) return answer;
  answer.text = std::move(what);
  answer.client = std::move(client);
  return answer;
}

}  // namespace runnel
