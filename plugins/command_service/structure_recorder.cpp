#include "plugins/command_service/structure_recorder.h"

#include <utility>

#include "core/plugin/module_type_name.h"
#include "plugins/command_service/command_worker.h"

namespace runnel {

void StructureRecorder::Add(std::string text) {
  if (!CommandWorker::IsThisThread()) log_.Add(ApplicationLog::Kind::kChange, std::move(text));
}

void StructureRecorder::OnReady(FrameworkElement& element) {
  const std::string type = FindModuleType(element);
  Add("put in " + element.path() + (type.empty() ? "" : " (" + type + ")"));
}
void StructureRecorder::OnDeleted(FrameworkElement& element) { Add("took out " + element.path()); }
void StructureRecorder::OnConnected(FrameworkElement& from, FrameworkElement& to) {
  Add("connected " + from.path() + " to " + to.path());
}
void StructureRecorder::OnDisconnected(FrameworkElement& from, FrameworkElement& to) {
  Add("disconnected " + from.path() + " from " + to.path());
}

}  // namespace runnel
