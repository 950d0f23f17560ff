#include "plugins/services/cycle_work.h"

#include <memory>

#include "core/base/exception_text.h"
#include "core/module/wake_source.h"

namespace runnel {

CycleWork* CycleWork::Add(FrameworkElement& element, CyclePart& part) {
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

std::vector<Task> CycleWork::Wrap(std::vector<Task> tasks) {
  if (tasks.empty()) return tasks;
  if (!module_) module_ = tasks.front().run;
  tasks.front().run = BoundCall::To<&CycleWork::Run>(*this);
  return tasks;
}

void CycleWork::Run() {
  try {
    for (CyclePart* part : parts_) part->BeforeUpdate();
    (*module_)();
  } catch (...) {
    const std::string what = DescribeException();
    for (CyclePart* part : parts_) part->AfterFault(what);
    throw;
  }
}

}  // namespace runnel
