// From which level on modules log.

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/element/element_path.h"
#include "core/log/log_levels.h"
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

// What has been set below `from`, or there, is from now on of what is at the same place below `to`.
void MoveLevels(Runtime& runtime, const std::string& from, const std::string& to) {
  for (const auto& [path, level] : ReadLogLevels(runtime)) {
    if (!IsAtOrBelow(path, from)) continue;
    SetLogLevel(runtime, to + path.substr(from.size()), level);
    (void)ResetLogLevel(runtime, path);
  }
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

void Plan::MoveLogLevels(const std::string& from, const std::string& to) {
  auto has_moved = std::make_shared<bool>(false);
  steps_.push_back({[=, this]() -> Result<void> {
                      *has_moved = true;
                      MoveLevels(runtime_, from, to);
                      return {};
                    },
                    [=, this] {
                      if (*has_moved) MoveLevels(runtime_, to, from);
                    },
                    [](auto&) { return ChangeSet(); }});
}

void AddLogLevel(const FrameworkElement& element, ChangeSet& changes) {
  if (const auto level = LevelOf(element.runtime(), element.path())) {
    changes.push_back(LogElement{element.path(), level});
  }
}

}  // namespace runnel::internal
