#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/channel/subscribers.h"
#include "core/element/annotation.h"
#include "core/module/executable.h"

namespace runnel {

/// Something that has to be done in a module's cycle, before the module itself.
class CyclePart {
 public:
  virtual void BeforeUpdate() = 0;
  /// Whom to wake if there is something to do; nullptr: nobody (WakeSource).
  virtual void SetWaker(Waker* waker) = 0;
  /// The module, or a part of it, has thrown.
  virtual void AfterFault(std::string_view /*what*/) noexcept {}

 protected:
  ~CyclePart() = default;
};

/// The parts of a module's cycle, in the order in which they were made. Runs as part of the module's first task, so
/// that a part is what the module itself is to schedules, faults, pauses and figures.
///
/// Threads: parts come and go while the module does not run.
class CycleWork final : public Annotation {
 public:
  /// Of the module that `element` is part of; nullptr if nothing there is executed: the owner does it itself.
  static CycleWork* Add(FrameworkElement& element, CyclePart& part) {
    FrameworkElement* module = &element;
    while (module != nullptr && module->FindAnnotation<Executable>() == nullptr) module = module->parent();
    if (module == nullptr) return nullptr;
    CycleWork* const work = &module->FindOrAnnotate<CycleWork>();
    // Done as a whole, or again the next time.
    if (work->element_ == nullptr) {
      auto executable = std::make_unique<Executable>(
          [work, inner = *module->FindAnnotation<Executable>()] { return work->Wrap(inner.tasks()); });
      module->Annotate(std::make_unique<WakeSource>([work](Waker* waker) {
        for (CyclePart* each : work->parts_) each->SetWaker(waker);
      }));
      module->Annotate(std::move(executable));  // in the place of the other one: needs no memory
      work->element_ = module;
    }
    work->parts_.push_back(&part);
    return work;
  }
  void Remove(CyclePart& part) noexcept { std::erase(parts_, &part); }
  [[nodiscard]] FrameworkElement& module() const noexcept { return *element_; }

 private:
  void Run() {
    try {
      for (CyclePart* part : parts_) part->BeforeUpdate();
      (*module_)();
    } catch (...) {
      const std::string what = DescribeException();
      for (CyclePart* part : parts_) part->AfterFault(what);
      throw;
    }
  }
  [[nodiscard]] std::vector<Task> Wrap(std::vector<Task> tasks) {
    if (tasks.empty()) return tasks;
    if (!module_) module_ = tasks.front().run;
    tasks.front().run = BoundCall::To<&CycleWork::Run>(*this);
    return tasks;
  }

  FrameworkElement* element_ = nullptr;
  std::vector<CyclePart*> parts_;
  std::optional<BoundCall> module_;  // once tasks have been asked for, always the same
};

}  // namespace runnel
