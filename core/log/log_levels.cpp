#include "core/log/log_levels.h"

#include <memory>
#include <mutex>
#include <utility>

#include "core/element/runtime.h"
#include "core/log/internal/log_dispatcher.h"

namespace runnel {

namespace {

/// Lies at the root, so that what was set goes with the runtime.
class LevelsOfRuntime final : public Annotation {
 public:
  explicit LevelsOfRuntime(const Runtime& runtime) : runtime_(runtime) {}
  LevelsOfRuntime(const LevelsOfRuntime&) = delete;
  LevelsOfRuntime& operator=(const LevelsOfRuntime&) = delete;
  ~LevelsOfRuntime() override { internal::LogDispatcher::OfProcess().ForgetLevels(runtime_); }

 private:
  const Runtime& runtime_;
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
