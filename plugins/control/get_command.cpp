#include <mutex>
#include <optional>

#include "core/element/configurable.h"
#include "core/paths/path_search.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/control/command.h"
#include "plugins/control/readable_text.h"
#include "plugins/values/watched_port.h"

namespace runnel {

namespace {

// Of a parameter, as `set` takes it.
Result<std::string> ValueOf(Runtime& runtime, const std::string& path) {
  const auto parameter = PathSearch(runtime).Find(path, PathKind::kParameter);
  if (parameter) {
    if (const auto* const found = dynamic_cast<const Configurable*>(*parameter)) return found->ToText();
  }
  const auto found = PathSearch(runtime).FindPort(path, PathKind::kOutput);
  if (!found) return parameter ? found.error() : parameter.error();
  const Port& port = **found;
  if (!port.type().is_transparent()) {
    return Error{.message = "values of type " + port.type().name() + " have no text format",
                 .path = port.path()};
  }
  std::optional<std::string> text;
  if (VisitShown(port, [&](const void* value, ValueTimes) { text = ToText(port.type(), value); })) return *text;
  return Error{.message = "nothing has been published there yet", .path = port.path()};
}

}  // namespace

CommandResult MakeGetCommand(const Request& request, const CommandContext& context) {
  Runtime& runtime = context.application.runtime;
  return Command(UnderLock(runtime, [&runtime, path = request.arguments[0],
                                     is_full = request.Has("full")](Answer& answer) -> CommandStep {
    const auto value = ValueOf(runtime, path);
    if (!value) return Refuse(answer, value.error());
    answer.Write((is_full ? *value : ReadableNumbers(*value)) + "\n");
    return ControlCode::kDone;
  }));
}

}  // namespace runnel
