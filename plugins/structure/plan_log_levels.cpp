// From which level on modules log.

#include <memory>
#include <optional>
#include <string>

#include "core/log/log_level.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

namespace {

// What has been set for this very path.
std::optional<LogLevel> LevelOf(Runtime& runtime, const std::string& path) {
  for (const auto& [whose, level] : ReadLogLevels(runtime)) {
    if (whose == path) return level;
  }
  return {};
}

void SetLevel(Runtime& runtime, const std::string& path, std::optional<LogLevel> level) {
  if (level) return SetLogLevel(runtime, path, *level);
  (void)ResetLogLevel(runtime, path);
}

}  // namespace

Result<void> Plan::Check(const LogElement& change) {
  std::string path;  // of everything
  if (!change.path.empty() && change.path != "/") {
    const auto found = overlay_.Find(change.path);
    if (!found) return found.error();
    path = (*found)->path();
  }
  auto before = std::make_shared<std::optional<std::optional<LogLevel>>>();
  steps_.push_back({[=, this, level = change.level]() -> Result<void> {
                      *before = LevelOf(runtime_, path);
                      SetLevel(runtime_, path, level);
                      return {};
                    },
                    [=, this] {
                      if (*before) SetLevel(runtime_, path, **before);
                    },
                    [=, this](auto&) -> ChangeSet {
                      return {LogElement{path.empty() ? "/" : path, LevelOf(runtime_, path)}};
                    }});
  return {};
}

}  // namespace runnel::internal
