#include "plugins/scheduling/thread_container.h"

#include <mutex>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/types/duration_text.h"
#include "plugins/scheduling/cycle_runner.h"

namespace runnel {

namespace {

constexpr int kHighestPriority = 99;
constexpr std::uint64_t kNoThread = 0;

struct ThreadAssignment final : Annotation {
  ThreadAssignment(std::uint64_t thread_id, AssignedBy who) : id(thread_id), by(who) {}
  std::unique_ptr<Annotation> ForReplacement() const override {
    return by != AssignedBy::kModule ? std::make_unique<ThreadAssignment>(id, by) : nullptr;
  }
  // The number and not the address: that of a container that is gone never comes back.
  std::uint64_t id;
  AssignedBy by;
};

void SetAssignment(FrameworkElement& element, std::uint64_t thread, AssignedBy who) {
  Runtime& runtime = element.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  element.Annotate(std::make_unique<ThreadAssignment>(thread, who));
  runtime.ForEachListener([&](ElementListener& listener) {
    if (auto* const told = dynamic_cast<AssignmentListener*>(&listener)) told->OnAssigned(element);
  });
}

}  // namespace

ThreadContainer::ThreadContainer(const Placement& placement, const ThreadOptions& options)
    : FrameworkElement(placement, ElementKind::kThread), runner_(std::make_shared<CycleRunner>(path(), options)) {
  if (auto good = Check(options, path()); !good) throw ElementError(good.error());
}

ThreadContainer::~ThreadContainer() = default;

ThreadOptions ThreadContainer::options() const noexcept { return runner_->options(); }

Result<void> ThreadContainer::Check(const ThreadOptions& options, const std::string& path) {
  if (options.activation != ThreadOptions::Activation::kTrigger && options.period <= Duration::zero()) {
    return Error{.message = "the period of a thread must be positive", .path = path, .hint = "for example 0.01 s"};
  }
  if (options.priority < 0 || options.priority > kHighestPriority) {
    return Error{.message = "priority " + std::to_string(options.priority) + " of a thread is out of bounds",
                 .path = path,
                 .hint = "0 is ordinary scheduling, 1 .. 99 is SCHED_FIFO"};
  }
  return {};
}

Result<void> ThreadContainer::SetOptions(const ThreadOptions& options) {
  if (auto good = Check(options, path()); !good) return good;
  const std::lock_guard lock(runtime().structure_mutex());
  runner_->set_options(options);
  runtime().root().Visit([this](FrameworkElement& each) {
    auto* const found = each.FindAnnotation<ThreadAssignment>();
    if (found != nullptr && found->id == id() && found->by == AssignedBy::kNobody) found->by = AssignedBy::kUser;
  });
  runtime().ForEachListener([&](ElementListener& listener) {
    if (auto* const told = dynamic_cast<AssignmentListener*>(&listener)) told->OnOptionsChanged(*this);
  });
  return {};
}

CycleStatistics ThreadContainer::statistics() const noexcept { return runner_->statistics(); }

const std::vector<std::string>& ActivationNames() {
  static const std::vector<std::string> names{"period", "free_running", "trigger"};
  return names;
}

const std::vector<std::string>& OverrunNames() {
  static const std::vector<std::string> names{"skip", "catch_up"};
  return names;
}

std::string ActivationText(const ThreadOptions& options) {
  using Activation = ThreadOptions::Activation;
  if (options.activation == Activation::kPeriod) return "every " + DurationText(options.period);
  return options.activation == Activation::kTrigger ? "when data comes" : "free-running";
}

ThreadContainer& CreateThread(Runtime& runtime, const std::string& name, const ThreadOptions& options) {
  const std::lock_guard lock(runtime.structure_mutex());
  FrameworkElement* threads = runtime.root().FindChild("threads");
  if (threads == nullptr) threads = &runtime.Create<Group>(runtime.root(), "threads");
  auto& container = runtime.Create<ThreadContainer>(*threads, name, options);
  // Neither the group nor the container has a Prepare() that could fail.
  (void)runtime.MakeReady(*threads);
  return container;
}

void AssignThread(FrameworkElement& element, ThreadContainer& thread, AssignedBy who) {
  RUNNEL_CHECK(&element.runtime() == &thread.runtime(), "a thread runs modules of its own runtime only");
  SetAssignment(element, thread.id(), who);
}

// One that never was: what is above decides.
void UnassignThread(FrameworkElement& element) { SetAssignment(element, kNoThread, AssignedBy::kUser); }

std::uint64_t OwnThreadId(const FrameworkElement& element) {
  const auto* const found = element.FindAnnotation<ThreadAssignment>();
  return found != nullptr ? found->id : kNoThread;
}

std::uint64_t SavedThreadId(const FrameworkElement& element) {
  const auto* const found = element.FindAnnotation<ThreadAssignment>();
  return found != nullptr && found->by != AssignedBy::kNobody ? found->id : kNoThread;
}

// Threads are children of a group "threads", of the root or of an application.
ThreadContainer* OwnThread(const FrameworkElement& element) {
  const std::uint64_t own = OwnThreadId(element);
  if (own == 0) return nullptr;
  for (const FrameworkElement* at = &element; at != nullptr; at = at->parent()) {
    const FrameworkElement* const threads = at->FindChild("threads");
    if (threads == nullptr) continue;
    for (FrameworkElement* each : threads->children()) {
      if (each->id() == own) return dynamic_cast<ThreadContainer*>(each);
    }
  }
  return nullptr;
}

std::uint64_t AssignedThread(const FrameworkElement& element) {
  for (const FrameworkElement* at = &element; at != nullptr; at = at->parent()) {
    if (const std::uint64_t own = OwnThreadId(*at); own != 0) return own;
  }
  return 0;
}

}  // namespace runnel
