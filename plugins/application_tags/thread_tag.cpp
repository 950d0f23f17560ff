#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/element/file_notes.h"
#include "core/module/group.h"
#include "core/types/duration_text.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel {

namespace {

constexpr const char* kThreads = "threads";
constexpr std::size_t kHighestPriority = 99;

using Activation = ThreadOptions::Activation;

void ReadPeriod(const TagUse& use, ThreadOptions& options) {
  const XmlAttribute* const period = use.Find("period");
  if (period != nullptr) options.period = ParseDuration(period->value).value();
  if (options.activation == Activation::kPeriod && period == nullptr) {
    use.Report({.message = "<thread> has no 'period'",
                .hint = "add period=\"50ms\", or activation=\"trigger\" or activation=\"free_running\""},
               use.xml.position());
  }
  if (options.activation == Activation::kTrigger && period != nullptr) {
    use.Report(
        {.message = "a thread that waits for data has no period", .hint = "leave out either period or activation"},
        period->position);
  }
}

void ReadPriority(const TagUse& use, ThreadOptions& options) {
  const XmlAttribute* const priority = use.Find("priority");
  if (priority == nullptr) return;
  const std::size_t count = ParseCount(priority->value).value();
  if (count <= kHighestPriority) {
    options.priority = static_cast<int>(count);
    return;
  }
  use.Report({.message = "priority " + priority->value + " is out of bounds",
              .hint = "0 is ordinary scheduling, 1 .. 99 is SCHED_FIFO"},
             priority->value_position);
}

FrameworkElement* MakeThread(const TagUse& use) {
  Runtime& runtime = use.context.runtime();
  FrameworkElement* threads = use.parent.FindChild(kThreads);
  if (threads == nullptr) {
    threads = &runtime.Create<Group>(use.parent, kThreads);
    threads->Annotate(std::make_unique<NotSaved>());
  }
  // Errors name the path that the thread really has.
  const TagUse inside{use.xml, *threads, use.context};
  if (!inside.HasFreeName(*threads)) return nullptr;
  ThreadOptions options;
  options.activation = internal::Chosen<Activation>(use, "activation", ActivationNames());
  ReadPeriod(inside, options);
  ReadPriority(inside, options);
  options.on_overrun = internal::Chosen<ThreadOptions::OnOverrun>(use, "on_overrun", OverrunNames());
  return &runtime.Create<ThreadContainer>(*threads, inside.Get("name").value, options);
}

void Assign(const XmlAttribute& name, FrameworkElement& element, BuildContext& context) {
  const FrameworkElement& application = internal::ApplicationOf(element);
  const FrameworkElement* const threads = application.FindChild(kThreads);
  std::vector<std::string> known;
  if (threads != nullptr) {
    auto* const thread = dynamic_cast<ThreadContainer*>(threads->FindChild(name.value));
    if (thread != nullptr) {
      AssignThread(element, *thread);
      return;
    }
    known = NamesOf(threads->children(), &FrameworkElement::name);
  }
  if (!context.IsNews(application, name.value, known)) return;
  context.Report({.message = "there is no thread '" + name.value + "'",
                  .hint = known.empty() ? "add <thread name=\"" + name.value + "\" period=\"50ms\"/> to the application"
                                        : NearestNameHint(name.value, known)},
                 name.value_position, element);
}

SavedTag SavedThread(const ThreadContainer& thread) {
  const ThreadOptions& options = thread.options();
  const bool has_period = options.activation != Activation::kTrigger;
  std::vector<SavedAttribute> tag{{"name", thread.name()}};
  if (has_period) {
    tag.push_back({"period", DurationText(options.period),
                   options.activation == Activation::kFreeRunning && options.period == ThreadOptions{}.period});
  }
  tag.push_back({"activation", ActivationNames()[static_cast<std::size_t>(options.activation)],
                 options.activation == Activation::kPeriod});
  tag.push_back({"priority", std::to_string(options.priority), options.priority == 0});
  tag.push_back({"on_overrun", OverrunNames()[static_cast<std::size_t>(options.on_overrun)],
                 options.on_overrun == ThreadOptions::OnOverrun::kSkip});
  return SavedTag{std::move(tag)};
}

// Those of the application, and those of the runtime that C++ code may have made.
std::vector<ThreadContainer*> ReachableThreads(const FrameworkElement& application) {
  std::vector<ThreadContainer*> threads;
  const FrameworkElement* const owners[] = {&application, application.parent()};
  for (const FrameworkElement* owner : owners) {
    const FrameworkElement* const group = owner->FindChild(kThreads);
    if (group == nullptr) continue;
    for (FrameworkElement* child : group->children()) {
      if (auto* thread = dynamic_cast<ThreadContainer*>(child)) threads.push_back(thread);
    }
  }
  return threads;
}

std::vector<SavedTag> SavedThreads(FrameworkElement& application) {
  std::set<std::uint64_t> used;
  application.Visit([&](FrameworkElement& each) { used.insert(SavedThreadId(each)); });
  std::vector<SavedTag> tags;
  for (const ThreadContainer* thread : ReachableThreads(application)) {
    if (thread->IsAtOrBelow(application) || used.contains(thread->id())) {
      tags.push_back(SavedThread(*thread));
    }
  }
  return tags;
}

// "" also if the thread is gone, for then the assignment means nothing.
std::string SavedAssignment(FrameworkElement& element) {
  const std::uint64_t id = SavedThreadId(element);
  if (id == 0) return "";
  for (const ThreadContainer* thread : ReachableThreads(internal::ApplicationOf(element))) {
    if (thread->id() == id) return thread->name();
  }
  return "";
}

}  // namespace

XmlTag ThreadTag() {
  return {
      .name = "thread",
      .summary = "a thread that runs modules, in the order of the data flow",
      .parents = {"application"},
      .attributes = {{.name = "name", .kind = AttributeKind::kNewName, .required = true},
                     KindRule("period", AttributeKind::kDuration,
                              "from cycle to cycle; of a free-running thread, what a cycle takes in simulated time"),
                     WordRule("activation", ActivationNames(),
                              "when a cycle begins: every period, at the end of the last one, or when data comes"),
                     KindRule("priority", AttributeKind::kCount, "0: ordinary; 1 .. 99: real-time, SCHED_FIFO"),
                     WordRule("on_overrun", OverrunNames(),
                              "what happens to cycles that were missed: left out (by default), or run at once")},
      .is_structure = true,
      .handle = MakeThread,
      .saved = SavedThreads};
}

AddedAttribute ThreadAttribute(std::string tag) {
  return {
      .tag = std::move(tag),
      .rule = KindRule("thread", AttributeKind::kName, "the thread that runs it and all within that names no other"),
      .handle =
          [](const XmlAttribute& name, FrameworkElement& element, BuildContext& context) {
            context.Defer(BuildStage::kConnections, [&name, &element, &context] { Assign(name, element, context); });
          },
      .saved = SavedAssignment};
}

}  // namespace runnel
