#include "plugins/control/command.h"

namespace runnel {

namespace {

constexpr std::size_t kEntriesAtOnce = 500;
constexpr Duration kLookForNew = std::chrono::milliseconds(100);

class LogCommand final : public Command {
 public:
  LogCommand(const ApplicationLog& log, bool follows) : log_(log), follows_(follows) {}

  std::optional<ControlCode> Continue(Answer& answer) override {
    const ApplicationLog::Lines read = log_.Read(next_, kEntriesAtOnce);
    std::string text;
    if (read.lost > 0) text = "(" + std::to_string(read.lost) + " earlier entries are gone)\n";
    for (const std::string& line : read.lines) text += line + "\n";
    if (!text.empty()) answer.Write(text);
    next_ = read.next;
    if (!read.lines.empty()) return {};
    if (!follows_) return ControlCode::kDone;
    ContinueIn(kLookForNew);
    return {};
  }

 private:
  const ApplicationLog& log_;
  const bool follows_;
  std::uint64_t next_ = 0;
};

}  // namespace

CommandResult MakeLogCommand(const Request& request, const ServedApplication& application) {
  return std::unique_ptr<Command>(
      std::make_unique<LogCommand>(application.log, request.Has("follow")));
}

}  // namespace runnel
