#pragma once

#include "core/element/element_listener.h"
#include "core/element/runtime.h"
#include "plugins/command_service/application_log.h"

namespace runnel {

/// Writes into the log what others than clients change: those have their changes logged as they wrote
/// them.
class StructureRecorder final : public ElementListener {
 public:
  StructureRecorder(Runtime& runtime, ApplicationLog& log) : runtime_(runtime), log_(log) {
    runtime_.AddListener(*this);
  }
  ~StructureRecorder() { runtime_.RemoveListener(*this); }

  void OnReady(FrameworkElement& element) override;
  void OnDeleted(FrameworkElement& element) override;
  void OnConnected(FrameworkElement& from, FrameworkElement& to) override;
  void OnDisconnected(FrameworkElement& from, FrameworkElement& to) override;

 private:
  void Add(std::string text);

  Runtime& runtime_;
  ApplicationLog& log_;
};

}  // namespace runnel
