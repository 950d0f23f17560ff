#include <chrono>
#include <memory>
#include <optional>

#include "plugins/command_service/extension_texts.h"
#include "plugins/control/command.h"

namespace runnel {

Command ShowExtensionText(Runtime& runtime, const std::string& name, const std::string& argument, Duration patience) {
  return Command(UnderLock(runtime, [&runtime, name, argument, patience, latest = std::optional<Command::SteadyTime>(),
                                     asking = std::shared_ptr<void>()](Answer& answer) mutable -> CommandStep {
    const ExtensionTexts::Text* const text = ExtensionTexts::Find(runtime, name);
    if (text == nullptr) {
      return Refuse(answer, {.message = "the application has no network", .hint = "add <network/> to its file"});
    }
    if (!latest) latest = std::chrono::steady_clock::now() + patience;  // the lock may have come late
    const auto told = (*text)(argument, asking);
    if (!told) return Refuse(answer, told.error());
    if (*told) {
      answer.Write(**told);
      return ControlCode::kDone;
    }
    if (std::chrono::steady_clock::now() < *latest) return kLookAgain;
    asking.reset();  // whoever is told that it has failed does not find it done later
    answer.WriteError(ErrorLine({.message = "nobody in the network has answered",
                                 .path = argument,
                                 .hint = "who is listed by 'runnel network' all the same is held up, or cannot reach this application"}));
    return ControlCode::kFailed;
  }));
}

CommandResult MakeNetworkCommand(const Request&, const CommandContext& context) {
  return ShowExtensionText(context.application.runtime, "network", "");
}

}  // namespace runnel
