#include <chrono>

#include "core/base/nearest_name.h"
#include "plugins/command_service/extension_texts.h"
#include "plugins/control/command.h"

namespace runnel {

namespace {

// So long a client waits for what comes from elsewhere.
constexpr auto kLongestWait = std::chrono::seconds(3);

ExtensionTexts::Text* FindText(Runtime& runtime, const std::string& name) {
  for (FrameworkElement* const each : runtime.root().children()) {
    auto* const texts = each->FindAnnotation<ExtensionTexts>();
    if (texts == nullptr) continue;
    if (const auto found = texts->texts.find(name); found != texts->texts.end()) return &found->second;
  }
  return nullptr;
}

}  // namespace

Command ShowExtensionText(Runtime& runtime, const std::string& name, const std::string& argument) {
  const auto latest = std::chrono::steady_clock::now() + kLongestWait;
  return Command(UnderLock(runtime, [&runtime, name, argument, latest](Answer& answer) -> CommandStep {
    const ExtensionTexts::Text* const text = FindText(runtime, name);
    if (text == nullptr) {
      return Refuse(answer, {.message = "the application has no network", .hint = "add <network/> to its file"});
    }
    const auto told = (*text)(argument);
    if (!told) return Refuse(answer, told.error());
    if (*told) {
      answer.Write(**told);
      return ControlCode::kDone;
    }
    if (std::chrono::steady_clock::now() < latest) return kLookAgain;
    answer.WriteError(ErrorLine({.message = "nobody in the network tells it", .path = argument}));
    return ControlCode::kFailed;
  }));
}

CommandResult MakeNetworkCommand(const Request&, const CommandContext& context) {
  return ShowExtensionText(context.application.runtime, "network", "");
}

}  // namespace runnel
