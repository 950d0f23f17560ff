#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "core/paths/distant_ports.h"
#include "core/paths/path_search.h"
#include "plugins/command_service/extension_texts.h"
#include "plugins/control/command.h"
#include "plugins/control/element_listing.h"

namespace runnel {

namespace {

// How long rates are counted for a long listing, by the machine's clock.
constexpr Duration kRateWindow = std::chrono::milliseconds(500);

// Of the log.
constexpr std::size_t kEntriesAtOnce = 500;
constexpr Duration kLookForNew = std::chrono::milliseconds(100);

// Says what `text` makes under the lock.
Command Told(Runtime& runtime, std::function<std::string()> text) {
  return Command(UnderLock(runtime, [text = std::move(text)](Answer& answer) { return Say(answer, text()); }));
}

}  // namespace

Command ShowExtensionText(Runtime& runtime, const std::string& name, const std::string& argument, Duration patience) {
  return Command(UnderLock(
      runtime,
      [&runtime, name, argument, patience, latest = std::optional<Command::SteadyTime>(),
       asking = std::shared_ptr<void>()](Answer& answer) mutable -> CommandStep {
        const ExtensionTexts::Text* const text = ExtensionTexts::Find(runtime, name);
        if (text == nullptr) {
          return Refuse(answer, {.message = "the application has no network", .hint = "add <network/> to its file"});
        }
        if (!latest) latest = std::chrono::steady_clock::now() + patience;  // the lock may have come late
        const auto told = (*text)(argument, asking);
        if (!told) return Refuse(answer, told.error());
        if (*told) return Say(answer, **told);
        if (std::chrono::steady_clock::now() < *latest) return kLookAgain;
        asking.reset();  // whoever is told that it has failed does not find it done later
        return Fail(
            answer,
            {.message = "nobody in the network has answered",
             .path = argument,
             .hint = "who is listed by 'runnel network' all the same is held up, or cannot reach this application"});
      }));
}

CommandResult MakeNetworkCommand(const Request&, const CommandContext& context) {
  return ShowExtensionText(context.application.runtime, "network", "");
}

CommandResult MakeListCommand(const Request& request, const CommandContext& context) {
  if (!request.arguments.empty() && IsDistantPath(request.arguments[0])) {
    return ShowExtensionText(context.application.runtime, "structure", request.arguments[0]);
  }
  return Command(
      UnderLock(context.application.runtime,
                [&runtime = context.application.runtime, path = request.arguments.empty() ? "" : request.arguments[0],
                 options = ListingOptions{.scheduler = context.application.scheduler,
                                          .log = &context.application.log,
                                          .began = context.application.log.start(),
                                          .is_long = request.Has("long")},
                 has_looked = false](Answer& answer) mutable -> CommandStep {
                  const auto start = PathSearch(runtime).Find(path);
                  if (!start) return Refuse(answer, start.error());
                  if (options.is_long && !std::exchange(has_looked, true)) {
                    options.rates = LookAtRates(**start);
                    return kRateWindow;
                  }
                  options.now = runtime.clock().Now();
                  return Say(answer, ListElements(**start, options));
                }));
}

CommandResult MakePathsCommand(const Request&, const CommandContext& context) {
  Runtime& runtime = context.application.runtime;
  return Told(runtime, [&runtime] { return ListPaths(runtime.root()); });
}

CommandResult MakeTypesCommand(const Request&, const CommandContext& context) {
  // Plugins are loaded under the lock.
  return Told(context.application.runtime, [&modules = context.application.modules] {
    std::string text;
    for (const ModuleType* type : modules.All()) {
      text += type->name + (type->summary.empty() ? "" : "\t" + type->summary) + "\n";
    }
    return text;
  });
}

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
