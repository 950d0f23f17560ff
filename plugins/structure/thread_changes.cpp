// Threads that come, go and change while the application runs.

#include <memory>
#include <utility>

#include "core/element/runtime.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

namespace {

constexpr const char* kThreads = "/threads";

std::string PathOfThread(const std::string& name) {
  return name.find('/') != std::string::npos ? name : std::string(kThreads) + "/" + name;
}

Result<ThreadContainer*> FindThread(const StructureOverlay& overlay, const std::string& name) {
  const auto found = overlay.Find(PathOfThread(name));
  if (!found) return found.error();
  if (auto* const thread = dynamic_cast<ThreadContainer*>(*found)) return thread;
  return Error{.message = (*found)->path() + " is not a thread", .path = (*found)->path()};
}

// Whether any other thread begins cycles by itself.
bool IsLastToBegin(const ThreadContainer& thread) {
  bool is_last = true;
  thread.runtime().root().VisitAll<const ThreadContainer>([&](const ThreadContainer& other) {
    if (&other == &thread) return;
    if (other.options().activation != ThreadOptions::Activation::kTrigger) is_last = false;
  });
  return is_last;
}

}  // namespace

Result<void> Plan::Check(const AddThread& change) {
  const std::string path = PathOfThread(change.name);
  if (path.starts_with(std::string(kThreads) + "/") && !overlay_.Find(kThreads)) {
    if (auto made = Check(CreateGroup{kThreads}); !made) return made;
  }
  const auto place = overlay_.PlaceFor(path);
  if (!place) return place.error();
  // Who decides which threads run what looks there.
  if (place->parent.name() != "threads") {
    return Error{
        .message = "threads are made in the application's group 'threads'", .path = path, .hint = "leave out the path"};
  }
  UnlistedElement made(std::make_unique<ThreadContainer>(*place, change.options));
  return AddNew(std::move(made));
}

Result<void> Plan::Check(const ScheduleThread& change) {
  const auto found = FindThread(overlay_, change.thread);
  if (!found) return found.error();
  ThreadContainer* const thread = *found;
  ThreadOptions wanted = thread->options();
  wanted.period = change.period.value_or(wanted.period);
  wanted.priority = change.priority.value_or(wanted.priority);
  wanted.on_overrun = change.on_overrun.value_or(wanted.on_overrun);
  wanted.activation = change.activation.value_or(wanted.activation);
  if (change.period && wanted.activation == ThreadOptions::Activation::kTrigger) {
    return Error{.message = "a thread that waits for data has no period",
                 .path = thread->path(),
                 .hint = "leave out the period, or say activation=period, too"};
  }
  // Nothing would come from anywhere in simulated time, which ends then.
  const bool is_simulated = dynamic_cast<const ManualClock*>(&runtime_.clock()) != nullptr;
  if (is_simulated && change.activation == ThreadOptions::Activation::kTrigger && IsLastToBegin(*thread)) {
    return Error{.message = "no thread would be left that begins cycles without data: simulated time would end",
                 .path = thread->path(),
                 .hint = "make another one first: create thread NAME period=10ms"};
  }
  if (auto good = ThreadContainer::Check(wanted, thread->path()); !good) return good;
  AddSetting([thread] { return thread->options(); },
             [thread](const ThreadOptions& options) { return thread->SetOptions(options); }, wanted,
             [=](auto&) -> ChangeSet {
               const ThreadOptions now = thread->options();
               ScheduleThread back{.thread = thread->path()};
               const bool has_period = now.activation != ThreadOptions::Activation::kTrigger;
               if (change.period && has_period) back.period = now.period;
               if (change.activation) back.activation = now.activation;
               if (change.priority) back.priority = now.priority;
               if (change.on_overrun) back.on_overrun = now.on_overrun;
               return {back};
             });
  return {};
}

void AddThreadAgain(const ThreadContainer& thread, ChangeSet& changes) {
  changes.push_back(AddThread{thread.path(), thread.options()});
  thread.runtime().root().Visit([&](FrameworkElement& each) {
    if (OwnThreadId(each) == thread.id()) {
      changes.push_back(AssignToThread{each.path(), thread.path()});
    }
  });
}

Result<void> Plan::Check(const AssignToThread& change) {
  const auto found = overlay_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& element = **found;
  ThreadContainer* thread = nullptr;
  if (!change.thread.empty()) {
    const auto named = FindThread(overlay_, change.thread);
    if (!named) return named.error();
    thread = *named;
  }
  if (element.kind() != ElementKind::kModule && element.kind() != ElementKind::kGroup) {
    return Error{.message = "is neither a module nor a group, and no thread runs it", .path = element.path()};
  }
  Concern(element);
  const auto assign = [&element](ThreadContainer* to) -> Result<void> {
    to != nullptr ? AssignThread(element, *to) : UnassignThread(element);
    return {};
  };
  AddSetting([&element] { return OwnThread(element); }, assign, thread,
             [&element](auto&) -> ChangeSet {
               return {AssignToThread{element.path(), OwnThreadPath(element)}};
             });
  return {};
}

}  // namespace runnel::internal
