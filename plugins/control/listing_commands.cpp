#include <optional>

#include "core/port/path_search.h"
#include "plugins/control/command.h"
#include "plugins/control/element_listing.h"

namespace runnel {

namespace {

// How long rates are counted for a long listing, by the machine's clock.
constexpr Duration kRateWindow = std::chrono::milliseconds(500);

}  // namespace

CommandResult MakeListCommand(const Request& request, const ServedApplication& application) {
  return Command(UnderLock(
      application.runtime,
      [&runtime = application.runtime, path = request.arguments.empty() ? "" : request.arguments[0],
       options = ListingOptions{.is_long = request.Has("long")},
       counted_at = std::optional<Time>()](Answer& answer) mutable -> CommandStep {
        const auto start = PathSearch(runtime).Find(path);
        if (!start) return Refuse(answer, start.error());
        const Time now = runtime.clock().Now();
        if (options.is_long && !counted_at) {
          counted_at = now;
          options.before = CountPublications(**start);
          return kRateWindow;
        }
        if (counted_at) options.since = now - *counted_at;
        answer.Write(ListElements(**start, options));
        return ControlCode::kDone;
      }));
}

CommandResult MakePathsCommand(const Request&, const ServedApplication& application) {
  return Command(UnderLock(application.runtime,
                           [&runtime = application.runtime](Answer& answer) -> CommandStep {
                             answer.Write(ListPaths(runtime.root()));
                             return ControlCode::kDone;
                           }));
}

CommandResult MakeTypesCommand(const Request&, const ServedApplication& application) {
  // Plugins are loaded under it.
  return Command(UnderLock(
      application.runtime, [&modules = application.modules](Answer& answer) -> CommandStep {
        std::string text;
        for (const ModuleType* type : modules.All()) {
          text += type->name + (type->summary.empty() ? "" : "\t" + type->summary) + "\n";
        }
        answer.Write(text);
        return ControlCode::kDone;
      }));
}

}  // namespace runnel
