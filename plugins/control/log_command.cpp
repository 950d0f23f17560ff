#include "plugins/control/command.h"

namespace runnel {

namespace {

constexpr std::size_t kEntriesAtOnce = 500;
constexpr Duration kLookForNew = std::chrono::milliseconds(100);

}  // namespace

CommandResult MakeLogCommand(const Request& request, const CommandContext& context) {
  if (request.Has("level")) return MakeServiceCommand(request, context);
  return Command([&log = context.application.log, follows = request.Has("follow"),
                  next = std::uint64_t{0}](Answer& answer) mutable -> CommandStep {
    const ApplicationLog::Entries read = log.ReadEntries(next, kEntriesAtOnce);
    std::string text;
    if (read.lost > 0) text = "(" + std::to_string(read.lost) + " earlier entries are gone)\n";
    for (const auto& entry : read.entries) text += ApplicationLog::LineOf(entry) + "\n";
    if (!text.empty()) answer.Write(text);
    next = read.next;
    if (!read.entries.empty()) return Duration{};
    if (!follows) return ControlCode::kDone;
    return kLookForNew;
  });
}

}  // namespace runnel
