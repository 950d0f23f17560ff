#pragma once

#include <memory>
#include <string>

#include "apps/runnel/command_line.h"
#include "apps/runnel/workplace.h"
#include "core/base/result.h"
#include "plugins/control/control_log.h"
#include "plugins/control/control_server.h"
#include "plugins/inspector/inspector.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/structure_editor.h"
#include "plugins/web_server/web_server.h"

namespace runnel::program {

/// How others reach the running application: other processes of the user, and, if it is wanted, viewers
/// such as browsers.
///
/// Ownership:  what is given to Start() must outlive it.
class OutsideAccess {
 public:
  /// Says where viewers find it. That other processes cannot reach it is only warned of; an inspector
  /// that is asked for and cannot be had is an error.
  static Result<std::unique_ptr<OutsideAccess>> Start(const RunArguments& arguments,
                                                      Workplace& workplace,
                                                      FrameworkElement& application,
                                                      Scheduler& scheduler, StructureEditor& editor,
                                                      ChangeHistory& history, ControlLog& log);

  /// A module has been stopped.
  void Hear(const Fault& fault);
  /// No cycle will run any more.
  void NoteEnd(const std::string& verdict);

 private:
  OutsideAccess() = default;

  std::unique_ptr<ControlServer> control_;
  std::unique_ptr<Inspector> inspector_;
  std::unique_ptr<WebServer> web_;  // first to go: it uses the inspector
};

}  // namespace runnel::program
