#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/paths/late_connections.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {

/// An input and a parameter of one name.
class Twin final : public Module {
 public:
  using Module::Module;
  Input<double> input{this, "gain", {.required = true}};
  Parameter<double> gain{this, "gain", {.default_value = 1.0}};

 private:
  void Update() override {}
};

class ParameterInputs : public ::testing::Test {
 protected:
  ParameterInputs() { workshop_.Add<Twin>("test/twin"); }

  void Build(const std::string& inside) {
    ASSERT_TRUE(workshop_.Build("<application name=\"demo\">" + inside + "</application>"))
        << workshop_.diagnostics.ToString();
  }
  ChangeOutcome Apply(const ChangeSet& changes) { return editor_.Apply(changes); }
  [[nodiscard]] bool IsFed(const std::string& module) {
    return bool(workshop_.runtime.root().Find("/demo/" + module + "/parameter/gain/feed/gain"));
  }
  // "from -> to", with " waits" behind it.
  [[nodiscard]] std::vector<std::string> Late() {
    std::vector<std::string> all;
    const auto* const late = LateConnections::FindIn(workshop_.runtime);
    if (late == nullptr) return all;
    for (const LateConnection& each : late->all()) {
      all.push_back(each.from + " -> " + each.to + (each.waits_for ? " waits" : ""));
    }
    return all;
  }

  SavingWorkshop workshop_;
  StructureEditor editor_{workshop_.runtime, workshop_.plugins.modules(), nullptr};
};

inline constexpr const char* kModules =
    R"(<module name="source" type="test/source"/><module name="other" type="test/source"/>)";

}  // namespace runnel::testing
