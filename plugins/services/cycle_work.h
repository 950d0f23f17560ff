#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/channel/waker.h"
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
  static CycleWork* Add(FrameworkElement& element, CyclePart& part);
  void Remove(CyclePart& part) noexcept { std::erase(parts_, &part); }
  [[nodiscard]] FrameworkElement& module() const noexcept { return *element_; }

 private:
  void Run();
  [[nodiscard]] std::vector<Task> Wrap(std::vector<Task> tasks);

  FrameworkElement* element_ = nullptr;
  std::vector<CyclePart*> parts_;
  std::optional<BoundCall> module_;  // once tasks have been asked for, always the same
};

}  // namespace runnel
