#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/module/module.h"
#include "core/module/run_monitor.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/application/application.h"
#include "plugins/parameters/parameter.h"

namespace runnel::test {

/// Publishes 1, 2, 3 … times a factor.
class CountingSource final : public Module {
 public:
  using Module::Module;
  Output<double> count{this, "count"};
  Parameter<double> factor{this, "factor", {.default_value = 1.0, .bounds = {-10.0, 10.0}}};
  StaticParameter<std::string> label{this, "label"};

 private:
  Result<void> Prepare() override {
    if (label.Get() == "broken") return Error{.message = "it is broken"};
    return {};
  }
  void Update() override { count.Publish(++cycles_ * factor.Get()); }
  double cycles_ = 0;
};

/// Publishes 1000 more than what comes, with every cycle.
class CountingFilter final : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in", {.required = true}};
  Output<double> out{this, "out"};

 private:
  void Update() override { out.Publish(in.Get() + 1000); }
};

/// Publishes the negative of what comes; throws at what is above `limit`, and says so when it is over.
class CountingJudge final : public Module {
 public:
  explicit CountingJudge(const Placement& placement) : Module(placement) {
    Annotate(std::unique_ptr<RunMonitor>(std::make_unique<Monitor>(*this)));
  }
  Input<double> in{this, "in"};
  Output<double> out{this, "out"};
  Parameter<double> limit{this, "limit", {.default_value = 1e9}};
  Parameter<double> enough{this, "enough", {.default_value = 1e9}};

 private:
  struct Monitor final : RunMonitor {
    explicit Monitor(CountingJudge& judge_) : judge(judge_) {}
    [[nodiscard]] std::string Progress() const override { return "counting"; }
    [[nodiscard]] std::optional<RunOutcome> Outcome() const override {
      if (judge.in.Peek() && *judge.in.Peek() >= judge.enough.Get()) {
        return RunOutcome{"enough", "", true};
      }
      return std::nullopt;
    }
    CountingJudge& judge;
  };
  void Update() override {
    if (in.Get() > limit.Get()) throw std::runtime_error("that is too much");
    out.Publish(-in.Get());
  }
};

/// Says something when it is made ready, in each cycle, and at its end.
class CountingTalker final : public Module {
 public:
  using Module::Module;

 private:
  Result<void> Prepare() override {
    log().Info("ready");
    return {};
  }
  void Update() override {
    log().Debug("cycle {}", ++cycles_);
    if (cycles_ == 2) log().Warn("no echo for {} s", 2.5);
  }
  int cycles_ = 0;
};

template <typename M>
void AddType(PluginManager& plugins, std::string name) {
  const auto added = plugins.modules().Add(
      {std::move(name), "", "test",
       [](const Placement& placement) -> std::unique_ptr<FrameworkElement> { return std::make_unique<M>(placement); }});
  if (!added) throw std::logic_error(added.error().ToString());
}

inline void AddCountingTypes(PluginManager& plugins) {
  AddType<CountingSource>(plugins, "counting/source");
  AddType<CountingFilter>(plugins, "counting/filter");
  AddType<CountingJudge>(plugins, "counting/judge");
  AddType<CountingTalker>(plugins, "counting/talker");
}

/// An application of these types, from a text that is called "counting.xml" in errors.
inline LoadedApplication LoadCounting(std::string_view text, ApplicationOptions options = {}) {
  return Application::LoadFrom(
      [&](const BuildTools& tools) {
        AddCountingTypes(tools.plugins);
        const auto document = XmlDocument::Parse(text, "counting.xml");
        if (document) return BuildApplication(*document, "", tools, BuildMode::kConstruct);
        BuildOutcome failed;
        failed.diagnostics.Add(document.error());
        return failed;
      },
      std::move(options));
}

/// Source, filter and judge in a row, on simulated time in cycles of 10 ms, as fast as it can.
inline constexpr const char* kCounting = R"(<application name="counting">
  <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/>
  <module name="source" type="counting/source">
    <parameter name="factor" command_line="factor"/> <parameter name="label" command_line="label"/>
  </module>
  <module name="filter" type="counting/filter"/>
  <module name="judge" type="counting/judge">
    <parameter name="limit" command_line="limit"/> <parameter name="enough" command_line="enough"/>
  </module>
  <connect from="source/count" to="filter/in"/> <connect from="filter/out" to="judge/in"/>
</application>)";

/// The same on real time.
inline std::string CountingInRealTime() {
  std::string text = kCounting;
  const std::string clock = R"(<clock type="simulated" speed="0"/>)";
  return text.replace(text.find(clock), clock.size(), "<clock type=\"real\"/>");
}

}  // namespace runnel::test
