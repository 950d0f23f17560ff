#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/element/configurable.h"
#include "core/types/text_format.h"
#include "plugins/services/callable.h"
#include "plugins/testing/module_rig.h"

namespace runnel::test {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// The component of probe.gen, or another, as a module on its own, in cycles of 10 ms.
class ComponentTest : public testing::Test {
 protected:
  explicit ComponentTest(const std::string& type = "probe/probe") : rig(type, 10ms) {}

  static Port& PortOf(FrameworkElement& module, const std::string& name) {
    for (const char* group : {"output", "input"}) {
      FrameworkElement* at = module.FindChild(group);
      if (at != nullptr) at = at->FindChild(name);
      if (auto* port = dynamic_cast<Port*>(at)) return *port;
    }
    throw std::runtime_error("no port " + name);
  }
  Port& PortAt(const std::string& name) { return PortOf(rig.module, name); }
  Callable& ServiceAt(const std::string& name) { return *PortAt(name).FindAnnotation<Callable>(); }
  /// Calls a service; its arguments as text.
  std::unique_ptr<AnyCall> Begin(const std::string& service, const std::string& arguments = "") {
    Callable& callable = ServiceAt(service);
    auto call = callable.NewCall();
    if (!arguments.empty()) {
      const auto set = SetFromText(*callable.arguments(), arguments, call->arguments());
      EXPECT_TRUE(set) << (set ? "" : set.error().message);
    }
    EXPECT_EQ(call->Begin(rig.now(), 10s), CallStatus::kPending);
    return call;
  }
  /// What has come of it: the reply as text, the error, or "pending".
  std::string Outcome(const std::string& service, AnyCall& call) {
    switch (call.Poll(rig.now())) {
      case CallStatus::kPending:
        return "pending";
      case CallStatus::kAnswered: {
        const TypeInfo* const reply = ServiceAt(service).reply();
        return reply != nullptr ? ToText(*reply, call.reply()) : "done";
      }
      case CallStatus::kAborted:
        return "aborted: " + call.error();
      default:
        return call.error();
    }
  }
  /// The same, until something has.
  std::string Call(const std::string& service, const std::string& arguments = "", int most_cycles = 10) {
    const auto call = Begin(service, arguments);
    while (Outcome(service, *call) == "pending" && most_cycles-- > 0) rig.RunCycle();
    return Outcome(service, *call);
  }
  std::string Parameter(const std::string& name) {
    return dynamic_cast<Configurable&>(*rig.module.FindChild("parameter")->FindChild(name)).ToText();
  }
  std::string Newest(const std::string& port) {
    std::string text;
    Port& at = PortAt(port);
    at.VisitLatest([&](const void* value, ValueTimes) { text = ToText(at.type(), value); });
    return text;
  }

  ModuleRig<FrameworkElement> rig;
};

}  // namespace runnel::test
