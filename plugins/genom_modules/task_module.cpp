#include "plugins/genom_modules/task_module.h"

#include <mutex>

#include "core/base/nearest_name.h"
#include "core/module/wake_source.h"
#include "plugins/genom_modules/component_module.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel::genom_modules {

namespace {

// Threads are children of a group "threads", of the application or of the root; the nearest of that name.
Result<ThreadContainer*> FindThread(const FrameworkElement& from, const std::string& name) {
  std::vector<std::string> known;
  for (const FrameworkElement* at = from.parent(); at != nullptr; at = at->parent()) {
    const FrameworkElement* const threads = at->FindChild("threads");
    if (threads == nullptr) continue;
    if (auto* const found = dynamic_cast<ThreadContainer*>(threads->FindChild(name))) return found;
    for (const FrameworkElement* each : threads->children()) known.push_back(each->name());
  }
  return Error{.message = "there is no thread '" + name + "'", .hint = NearestNameHint(name, known)};
}

}  // namespace

std::string MissedTicks(const genom_execution::TaskTable& task, Duration cycle) {
  if (task.period % cycle == Duration::zero() && task.delay % cycle == Duration::zero()) return "";
  return std::string("task '") + task.name + "' has a period of " + TextOf(task.period) + " and a delay of " +
         TextOf(task.delay) + ", and its thread a period of " + TextOf(cycle) + ", which divides them not";
}

TaskModule::TaskModule(const Placement& placement, ComponentModule& component, std::size_t number, std::string thread,
                       WakeTarget& target)
    : Module(placement), component_(component), number_(number), thread_(std::move(thread)) {
  Annotate(std::make_unique<WakeSource>([&target](Waker* waker) { target.SetWaker(waker); }));
}

Result<void> TaskModule::Prepare() {
  const std::lock_guard lock(runtime().structure_mutex());
  const auto thread = FindThread(component_, thread_);
  if (!thread) return thread.error();
  if (auto good = Check(**thread); !good) return good;
  // What takes the component's place says anew who runs it.
  AssignThread(*this, **thread, AssignedBy::kModule);
  return {};
}

Result<void> TaskModule::Check(const ThreadContainer& thread) const {
  const genom_execution::TaskTable& task = component_.table().tasks[number_];
  if (task.period == Duration::zero()) return {};
  if (thread.options().activation == ThreadOptions::Activation::kTrigger) {
    return Error{.message = std::string("task '") + task.name + "' has a period, and thread '" + thread_ + "' waits for data",
                 .hint = "give it a thread with a period"};
  }
  if (thread.options().activation == ThreadOptions::Activation::kFreeRunning) return {};
  const std::string missed = MissedTicks(task, thread.options().period);
  if (missed.empty()) return {};
  return Error{.message = missed, .hint = "give thread '" + thread_ + "' a period that does"};
}

void TaskModule::Update() { component_.RunOwnTask(number_, now() + period() / 2); }

}  // namespace runnel::genom_modules
