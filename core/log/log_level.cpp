#include "core/log/log_level.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/element/runtime.h"
#include "core/log/internal/log_dispatcher.h"

namespace runnel {

namespace {

/// Kept with an element of which a level has been set, so that it goes where the element's other annotations go.
struct OwnLevel final : Annotation {
  explicit OwnLevel(std::optional<LogLevel> own) : level(own) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<OwnLevel>(level);
  }
  std::optional<LogLevel> level;  ///< none: as what is around it
};

/// Lies at the root, so that what was set goes with the runtime, and what was set of an element with that.
class LevelsOfRuntime final : public Annotation, private ElementListener {
 public:
  explicit LevelsOfRuntime(Runtime& runtime) : runtime_(runtime) { runtime.AddListener(*this); }
  LevelsOfRuntime(const LevelsOfRuntime&) = delete;
  LevelsOfRuntime& operator=(const LevelsOfRuntime&) = delete;
  ~LevelsOfRuntime() override { internal::LogDispatcher::OfProcess().ForgetLevels(runtime_); }

 private:
  void OnReady(FrameworkElement& element) override {
    element.Visit([this](FrameworkElement& each) {
      const auto* const own = each.FindAnnotation<OwnLevel>();
      if (own != nullptr && own->level) Dispatcher().SetLevel(runtime_, each.path(), *own->level);
    });
  }
  void OnDeleted(FrameworkElement& element) override {
    if (element.parent() == nullptr) return;
    for (const auto& [path, level] : ReadLogLevels(runtime_)) {
      if (IsAtOrBelow(path, element.path())) (void)Dispatcher().ResetLevel(runtime_, path);
    }
  }
  static internal::LogDispatcher& Dispatcher() { return internal::LogDispatcher::OfProcess(); }

  Runtime& runtime_;
};

// Under the structure lock. What is set of a path at which nothing is yet is of the first to be there.
void NoteAt(Runtime& runtime, const std::string& path, std::optional<LogLevel> level) {
  const auto found = runtime.root().Find(path.empty() ? "/" : path);
  if (found && (*found)->path() == path) (*found)->Annotate(std::make_unique<OwnLevel>(level));
}

}  // namespace

const std::array<std::string, 5>& LogLevelNames() {
  static const std::array<std::string, 5> names{"debug", "info", "warning", "error", "off"};
  return names;
}

const std::string& LogLevelName(LogLevel level) { return LogLevelNames().at(static_cast<std::size_t>(level)); }

Result<LogLevel> LogLevelOf(std::string_view name) {
  const auto& names = LogLevelNames();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    return Error{.message = "there is no log level '" + std::string(name) + "'; " + NearestNameHint(name, names)};
  }
  return static_cast<LogLevel>(found - names.begin());
}

void SetLogLevel(Runtime& runtime, std::string path, LogLevel level) {
  const std::lock_guard lock(runtime.structure_mutex());
  (void)runtime.root().FindOrAnnotate<LevelsOfRuntime>(runtime);
  NoteAt(runtime, path, level);
  internal::LogDispatcher::OfProcess().SetLevel(runtime, std::move(path), level);
}

LogLevels ReadLogLevels(Runtime& runtime) { return internal::LogDispatcher::OfProcess().Levels(runtime); }

bool ResetLogLevel(Runtime& runtime, const std::string& path) {
  const std::lock_guard lock(runtime.structure_mutex());
  NoteAt(runtime, path, std::nullopt);
  return internal::LogDispatcher::OfProcess().ResetLevel(runtime, path);
}

}  // namespace runnel
