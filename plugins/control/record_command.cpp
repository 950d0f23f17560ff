#include <chrono>
#include <utility>

#include "core/element/attempt.h"
#include "core/paths/distant_ports.h"
#include "core/paths/path_search.h"
#include "plugins/control/command.h"

namespace runnel {

namespace {

constexpr Duration kTellProgress = std::chrono::milliseconds(250);

/// Records until its client goes, or so long as that has said. What waits for the disk or for the structure
/// does so in the worker's thread.
class RecordCommand {
 public:
  RecordCommand(const RecordingHook& hook, RecordingRequest recording, std::optional<std::uint64_t> seconds,
                TaskGroup& tasks)
      : tasks_(tasks), seconds_(seconds), shared_(std::make_shared<Shared>()) {
    task_ = tasks_.Post([hook, recording = std::move(recording), shared = shared_] {
      shared->outcome = Attempt([&]() -> Result<std::string> {
        auto started = hook(recording);
        if (!started) return started.error();
        shared->recording = std::move(*started);
        return std::string();
      });
    });
  }
  // The client has gone: the worker brings the file to its end.
  ~RecordCommand() {
    if (!task_->is_done()) task_->Cancel();
    if (!has_ended_) {
      tasks_.Post([shared = shared_] { shared->recording.reset(); });
    }
  }

  RecordCommand(const RecordCommand&) = delete;
  RecordCommand& operator=(const RecordCommand&) = delete;

  CommandStep Continue(Answer& answer) {
    if (!task_->is_done()) return task_;
    if (!shared_->outcome) {
      has_ended_ = true;
      return has_begun_ ? Fail(answer, shared_->outcome.error()) : Refuse(answer, shared_->outcome.error());
    }
    if (is_ending_) {
      has_ended_ = true;
      return Say(answer, *shared_->outcome + "\n");
    }
    if (!std::exchange(has_begun_, true)) began_ = std::chrono::steady_clock::now();
    if (const auto failure = shared_->recording->Failure()) return Fail(answer, *failure);
    const bool is_long_enough =
        seconds_ && std::chrono::steady_clock::now() - began_ >= std::chrono::seconds(*seconds_);
    if (is_long_enough || answer.has_enough()) {
      End();
      return task_;
    }
    answer.Write(shared_->recording->Progress() + "\n");
    return kTellProgress;
  }

 private:
  struct Shared {
    Result<std::string> outcome = std::string();
    std::unique_ptr<ClientRecording> recording;
  };

  void End() {
    is_ending_ = true;
    task_ = tasks_.Post([shared = shared_] {
      shared->outcome = Attempt([&] { return shared->recording->Finish(); });
      shared->recording.reset();
    });
  }

  TaskGroup& tasks_;
  const std::optional<std::uint64_t> seconds_;
  const std::shared_ptr<Shared> shared_;
  std::shared_ptr<WorkerTask> task_;
  std::chrono::steady_clock::time_point began_{};
  bool has_begun_ = false;
  bool is_ending_ = false;
  bool has_ended_ = false;
};

}  // namespace

CommandResult MakeRecordCommand(const Request& request, const CommandContext& context) {
  const RecordingHook& record = context.application.hooks.record;
  if (!record) {
    return Error{.message = "the program that runs this application cannot record it"};
  }
  const auto seconds = ReadCountOption(request);
  if (!seconds) return seconds.error();
  if (request.Option("file").empty()) {
    return Error{.message = "'record' needs the file to record to, as file=…"};
  }
  auto recording = std::make_shared<std::unique_ptr<RecordCommand>>();
  const RecordingRequest wanted{request.Option("file"), request.arguments, request.Option("compression")};
  Runtime& runtime = context.application.runtime;
  const Command::Step begin = UnderLock(
      runtime,
      [&runtime, &tasks = context.tasks, record, wanted, seconds = *seconds, recording](Answer& answer) -> CommandStep {
        RecordingRequest here = wanted;
        for (std::string& each : here.ports) {
          if (!IsDistantPath(each)) continue;
          const auto port = PathSearch(runtime).FindPort(each, PathKind::kOutput);
          if (!port) return Refuse(answer, port.error());
          each = (*port)->path();  // the output that its values come to
        }
        *recording = std::make_unique<RecordCommand>(record, std::move(here), seconds, tasks);
        return (*recording)->Continue(answer);
      });
  return Command(
      [recording, begin](Answer& answer) { return *recording ? (*recording)->Continue(answer) : begin(answer); });
}

}  // namespace runnel
