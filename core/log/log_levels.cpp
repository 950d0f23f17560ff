#include "core/log/log_levels.h"

#include <memory>
#include <mutex>
#include <utility>

#include "core/element/element_listener.h"
#include "core/element/element_path.h"
#include "core/element/runtime.h"
#include "core/log/internal/log_dispatcher.h"

namespace runnel {

namespace {

/// Lies at the root, so that what was set goes with the runtime, and what was set of an application with that.
class LevelsOfRuntime final : public Annotation, private ElementListener {
 public:
  explicit LevelsOfRuntime(Runtime& runtime) : runtime_(runtime) { runtime.AddListener(*this); }
  LevelsOfRuntime(const LevelsOfRuntime&) = delete;
  LevelsOfRuntime& operator=(const LevelsOfRuntime&) = delete;
  ~LevelsOfRuntime() override { internal::LogDispatcher::OfProcess().ForgetLevels(runtime_); }

 private:
  void OnDeleted(FrameworkElement& element) override {
    if (element.parent() == nullptr || element.parent()->parent() != nullptr) return;
    const std::string whole = element.path();
    for (const auto& [path, level] : ReadLogLevels(runtime_)) {
      if (IsAtOrBelow(path, whole)) (void)ResetLogLevel(runtime_, path);
    }
  }

  Runtime& runtime_;
};

}  // namespace

void SetLogLevel(Runtime& runtime, std::string path, LogLevel level) {
  {
    const std::lock_guard lock(runtime.structure_mutex());
    if (runtime.root().FindAnnotation<LevelsOfRuntime>() == nullptr) {
      runtime.root().Annotate(std::make_unique<LevelsOfRuntime>(runtime));
    }
  }
  internal::LogDispatcher::OfProcess().SetLevel(runtime, std::move(path), level);
}

LogLevels ReadLogLevels(Runtime& runtime) {
  return internal::LogDispatcher::OfProcess().Levels(runtime);
}

bool ResetLogLevel(Runtime& runtime, const std::string& path) {
  return internal::LogDispatcher::OfProcess().ResetLevel(runtime, path);
}

}  // namespace runnel
