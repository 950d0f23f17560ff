#include <mutex>

#include "core/log/log_levels.h"
#include "core/port/path_search.h"
#include "plugins/control/command.h"

namespace runnel {

namespace {

constexpr std::size_t kEntriesAtOnce = 500;
constexpr Duration kLookForNew = std::chrono::milliseconds(100);

// "/robot=debug", or "debug" for all.
CommandResult MakeLevelCommand(const std::string& wish, Runtime& runtime) {
  const std::size_t equals = wish.rfind('=');
  const bool is_for_all = equals == std::string::npos;
  const auto level = LogLevelOf(is_for_all ? wish : wish.substr(equals + 1));
  if (!level) return level.error();
  return Command(UnderLock(runtime, [&runtime, level = *level,
                                     path = is_for_all ? "" : wish.substr(0, equals)](Answer& answer) -> CommandStep {
    std::string whose;
    if (!path.empty() && path != "/") {
      const auto found = PathSearch(runtime).Find(path);
      if (!found) return Refuse(answer, found.error());
      whose = (*found)->path();
    }
    SetLogLevel(runtime, whose, level);
    answer.Write((whose.empty() ? "/" : whose) + ": logs " + LogLevelName(level) + " and more\n");
    return ControlCode::kDone;
  }));
}

}  // namespace

CommandResult MakeLogCommand(const Request& request, const CommandContext& context) {
  if (request.Has("level")) {
    return MakeLevelCommand(request.options.at("level"), context.application.runtime);
  }
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
