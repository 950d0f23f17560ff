#include "plugins/control/command.h"

namespace runnel {

namespace {

constexpr Duration kLookWhetherDone = std::chrono::milliseconds(20);

class SaveCommand final : public Command {
 public:
  SaveCommand(const std::function<Result<std::string>(const std::string&)>& save, std::string file,
              ChangeWorker& worker)
      : saved_(std::make_shared<Result<std::string>>(std::string())) {
    job_ = worker.Post([save, file = std::move(file), saved = saved_] {
      try {
        *saved = save(file);
      } catch (const std::exception& exception) {
        *saved = Error{.message = exception.what(), .position = {.file = file}};
      }
    });
  }
  ~SaveCommand() override { job_->Cancel(); }

  std::optional<ControlCode> Continue(Answer& answer) override {
    ContinueIn(kLookWhetherDone);
    if (!job_->is_done()) return {};
    if (!*saved_) {
      answer.Complain(ErrorLine(saved_->error()));
      return ControlCode::kFailed;
    }
    answer.Write(**saved_ + "\n");
    return ControlCode::kDone;
  }

 private:
  const std::shared_ptr<Result<std::string>> saved_;
  std::shared_ptr<ChangeWorker::Job> job_;
};

}  // namespace

CommandResult MakeSaveCommand(const Request& request, const ControlledApplication& application,
                              ChangeWorker& worker) {
  if (!application.hooks.save) {
    return Error{.message = "the program that runs this application cannot save it"};
  }
  return std::unique_ptr<Command>(std::make_unique<SaveCommand>(
      application.hooks.save, request.words.empty() ? "" : request.words[0], worker));
}

}  // namespace runnel
