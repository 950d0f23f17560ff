#include "plugins/control/command.h"

namespace runnel {

namespace {

constexpr Duration kLookWhetherDone = std::chrono::milliseconds(20);

// What the program that runs the application does, in the thread for what may take long.
class HookCommand final : public Command {
 public:
  HookCommand(const std::function<Result<std::string>(const std::string&)>& hook, std::string word,
              ChangeWorker& worker)
      : done_(std::make_shared<Result<std::string>>(std::string())) {
    job_ = worker.Post([hook, word = std::move(word), done = done_] {
      try {
        *done = hook(word);
      } catch (const std::exception& exception) {
        *done = Error{.message = exception.what()};
      }
    });
  }
  ~HookCommand() override { job_->Cancel(); }

  std::optional<ControlCode> Continue(Answer& answer) override {
    ContinueIn(kLookWhetherDone);
    if (!job_->is_done()) return {};
    if (!*done_) {
      answer.Complain(ErrorLine(done_->error()));
      return ControlCode::kFailed;
    }
    answer.Write(**done_ + "\n");
    return ControlCode::kDone;
  }

 private:
  const std::shared_ptr<Result<std::string>> done_;
  std::shared_ptr<ChangeWorker::Job> job_;
};

}  // namespace

CommandResult MakeSaveCommand(const Request& request, const ControlledApplication& application,
                              ChangeWorker& worker) {
  if (!application.hooks.save) {
    return Error{.message = "the program that runs this application cannot save it"};
  }
  return std::unique_ptr<Command>(std::make_unique<HookCommand>(
      application.hooks.save, request.words.empty() ? "" : request.words[0], worker));
}

CommandResult MakeReloadCommand(const Request& request, const ControlledApplication& application,
                                ChangeWorker& worker) {
  if (!application.hooks.reload) {
    return Error{.message = "the program that runs this application cannot load plugins anew"};
  }
  return std::unique_ptr<Command>(
      std::make_unique<HookCommand>(application.hooks.reload, request.words[0], worker));
}

}  // namespace runnel
