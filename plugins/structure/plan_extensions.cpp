// Changes that extensions carry out, and from which level on modules log.

#include <optional>
#include <string>

#include "core/element/runtime.h"
#include "core/log/log_level.h"
#include "plugins/structure/change.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

namespace {

// All paths at or below `from` in the text go on below `to`. What stands between paths is no part of any name.
void MovePaths(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    const std::size_t end = at + from.size();
    const bool begins = at == 0 || text[at - 1] == ' ';
    const bool ends = end == text.size() || text[end] == '/' || text[end] == ' ' || text[end] == ',';
    if (begins && ends) text.replace(at, from.size(), to);
    at += begins && ends ? to.size() : 1;
  }
}

void TellFollowers(const FrameworkElement& root, const std::string& from, const std::string& to) {
  const auto* const followers = root.FindAnnotation<PathFollowers>();
  if (followers == nullptr) return;
  const auto move = [&](std::string& text) { MovePaths(text, from, to); };
  for (const auto& each : followers->all) each(move);
}

// What has been set for this very path.
std::optional<LogLevel> LevelOf(Runtime& runtime, const std::string& path) {
  for (const auto& [whose, level] : ReadLogLevels(runtime)) {
    if (whose == path) return level;
  }
  return {};
}

}  // namespace

Result<void> Plan::Check(const LogElement& change) {
  std::string path;  // of everything
  if (!change.path.empty() && change.path != "/") {
    const auto found = overlay_.Find(change.path);
    if (!found) return found.error();
    path = (*found)->path();
  }
  const auto get = [=, this] { return LevelOf(runtime_, path); };
  const auto set = [=, this](std::optional<LogLevel> level) -> Result<void> {
    level ? SetLogLevel(runtime_, path, *level) : (void)ResetLogLevel(runtime_, path);
    return {};
  };
  AddSetting(get, set, change.level, [=](auto&) -> ChangeSet {
    return {LogElement{path.empty() ? "/" : path, get()}};
  });
  return {};
}

Result<void> Plan::Check(const ExtensionChange& change) {
  const auto* const known = runtime_.root().FindAnnotation<ExtensionChanges>();
  const auto found = known != nullptr ? known->verbs.find(change.verb) : decltype(known->verbs.find(""))();
  if (known == nullptr || found == known->verbs.end()) {
    return Error{.message = "nothing of the application can '" + change.verb + "'",
                 .hint = "what is offered and taken needs <network/> in its file"};
  }
  auto step =
      found->second(change, [this](const std::string& path, PathKind kind) { return overlay_.FindPort(path, kind); });
  if (!step) return step.error();
  if (auto checked = CheckEach(step->changes); !checked) return checked;
  if (!step->apply) return {};
  steps_.push_back({step->apply, step->undo, [inverse = step->inverse](auto&) { return inverse(); }});
  return {};
}

void Plan::MoveExtensions(const FrameworkElement& renamed, const std::string& name) {
  const std::string from = renamed.path();
  const std::string to = renamed.parent()->path() + "/" + name;
  steps_.push_back({[=, this]() -> Result<void> {
                      TellFollowers(runtime_.root(), from, to);
                      return {};
                    },
                    [=, this] { TellFollowers(runtime_.root(), to, from); }});
  const auto* const known = runtime_.root().FindAnnotation<ExtensionChanges>();
  if (known == nullptr || !known->rename) return;
  const ExtensionStep step = known->rename(from, to);
  if (step.apply) steps_.push_back({step.apply, step.undo});
}

}  // namespace runnel::internal
