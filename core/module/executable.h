#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/channel/subscribers.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"

namespace runnel {

/// When in a cycle a task runs: what senses before what computes before what controls.
enum class Phase { kSense, kUpdate, kControl };

/// A member function bound to its object, to be called again and again: two words. Of a virtual
/// function it is the one that the object has when this is made, so make it when the object is
/// complete. The object must outlive it.
class BoundCall {
 public:
  /// For example BoundCall::To<&Module::Update>(*this).
  template <auto kFunction, typename Object>
  [[nodiscard]] static BoundCall To(Object& object) noexcept {
#if defined(__GNUC__) && !defined(__clang__)
    // GCC's bound member functions: the table of virtual functions is looked into here, once for
    // all calls, and saves each of them one of two jumps.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpmf-conversions"
#pragma GCC diagnostic ignored "-Wpedantic"
    const auto function = (void (*)(Object*))(object.*kFunction);
#pragma GCC diagnostic pop
    return {&object, reinterpret_cast<void (*)(void*)>(function)};
#else
    return {&object, [](void* bound) { (static_cast<Object*>(bound)->*kFunction)(); }};
#endif
  }

  void operator()() const { function_(object_); }

 private:
  BoundCall(void* object, void (*function)(void*)) noexcept : object_(object), function_(function) {}

  void* object_;
  void (*function_)(void*);
};

/// One function of an element that wants to be called once a cycle, and the port groups through
/// which its data comes and goes; an executor orders tasks along them.
struct Task {
  FrameworkElement* element;
  Phase phase;
  BoundCall run;
  std::vector<const FrameworkElement*> reads;   ///< groups of inputs
  std::vector<const FrameworkElement*> writes;  ///< groups of outputs
};

/// "I have something to do in each cycle": the annotation by which an executor finds what to run,
/// without the core knowing executors.
///
/// Threads:  tasks() is called under the structure lock; the tasks run in the executor's thread,
///           never two of one element at a time. What they throw is the executor's to catch and
///           report.
class Executable final : public Annotation {
 public:
  /// The groups are asked for late, since ports make them when they are constructed.
  explicit Executable(std::function<std::vector<Task>()> tasks) : tasks_(std::move(tasks)) {}
  [[nodiscard]] std::vector<Task> tasks() const { return tasks_(); }

 private:
  std::function<std::vector<Task>()> tasks_;
};

/// "Besides new data at my inputs, something else sets me off, if triggers do": the annotation of an element that is
/// Executable, by which an executor says whom to wake.
///
/// Threads: under the structure lock. What is set is woken inside an epoch guard, so that the executor knows when
///          nobody does any more.
class WakeSource final : public Annotation {
 public:
  /// `set`: from now on this waker; nullptr: nobody. It wakes at once if something waits already.
  explicit WakeSource(std::function<void(Waker*)> set) : set_(std::move(set)) {}
  void SetWaker(Waker* waker) const { set_(waker); }

 private:
  std::function<void(Waker*)> set_;
};

}  // namespace runnel
