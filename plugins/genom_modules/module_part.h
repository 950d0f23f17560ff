#pragma once

#include "core/base/clock.h"
#include "plugins/genom_execution/engine.h"

namespace runnel::genom_modules {

/// What a module has beside its engine, and looks after the engine's requests: a service, a parameter.
class ModulePart {
 public:
  /// Before the first cycle: makes room.
  virtual void Prepare(genom_execution::Engine& engine) = 0;
  /// In each cycle, before the passes of the tasks.
  virtual void BeforePasses(genom_execution::Engine& engine, Time now) = 0;
  /// And after them: what has been done is answered.
  virtual void AfterPasses() = 0;
  /// A call of a service has been successful.
  virtual void AfterCall(genom_execution::Request& /*request*/) {}

 protected:
  ~ModulePart() = default;
};

}  // namespace runnel::genom_modules
