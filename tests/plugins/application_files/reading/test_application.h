#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/element/file_notes.h"
#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_tags/application_tags.h"
#include "plugins/parameters/file_path.h"
#include "plugins/parameters/parameter.h"

namespace runnel::testing {

class Source final : public Module {
 public:
  explicit Source(const Placement& placement) : Module(placement) {
    gain.Annotate(std::make_unique<FormerName>("boost"));
  }
  Output<double> value{this, "value"};
  Output<std::string> label{this, "label"};
  Parameter<double> gain{this, "gain", {.default_value = 1.0, .bounds = {0.0, 10.0}, .unit = "m"}};
  Parameter<int> count{this, "count", {.default_value = 3}};
  StaticParameter<FilePath> file{this, "file"};
  StaticParameter<std::string> text{this, "text"};

 private:
  void Update() override {}
};

class Sink final : public Module {
 public:
  using Module::Module;
  Input<double> value{this, "value"};
  Input<double> second{this, "second"};
  Input<std::string> label{this, "label"};

 private:
  void Update() override {}
};

// Has an input and an output of one name, and an input that must be connected.
class Filter final : public Module {
 public:
  using Module::Module;
  Input<double> value_in{this, "value", {.required = true}};
  Output<double> value_out{this, "value"};

 private:
  void Update() override {}
};

class Unready final : public Module {
 public:
  using Module::Module;

 private:
  Result<void> Prepare() override { return Error{.message = "the file is not there"}; }
  void Update() override {}
};

class Unmakeable final : public Module {
 public:
  explicit Unmakeable(const Placement& placement) : Module(placement) { throw std::runtime_error("no such device"); }

 private:
  void Update() override {}
};

// A runtime, and builds from texts with the module types above.
struct Workshop {
  Runtime runtime;
  PluginManager plugins;
  XmlTagRegistry tags = ApplicationTags();
  Configuration configuration;
  Diagnostics diagnostics;

  Workshop() {
    Add<Source>("test/source");
    Add<Sink>("test/sink");
    Add<Filter>("test/filter");
    Add<Unready>("test/unready");
    Add<Unmakeable>("test/unmakeable");
  }

  template <typename M>
  void Add(std::string name) {
    const auto added = plugins.modules().Add(
        {std::move(name), "", "test", [](const Placement& placement) -> std::unique_ptr<FrameworkElement> {
           return std::make_unique<M>(placement);
         }});
    RUNNEL_CHECK(added.has_value(), "a test registers a type twice");
  }

  // Builds the text as if it stood in "/apps/app.xml". Errors go to `diagnostics`.
  FrameworkElement* Build(std::string_view text, BuildMode mode = BuildMode::kRun) {
    const auto document = XmlDocument::Parse(text, "app.xml");
    if (!document) {
      diagnostics.Add(document.error());
      return nullptr;
    }
    BuildOutcome outcome = BuildApplication(*document, "/apps", {runtime, plugins, tags, configuration}, mode);
    diagnostics = outcome.diagnostics;
    return outcome.application;
  }

  // What building says, one line for each error or warning.
  std::string Errors(std::string_view text, BuildMode mode = BuildMode::kRun) {
    Build(text, mode);
    return diagnostics.ToString();
  }

  template <typename T>
  T& Get(std::string_view path) {
    return dynamic_cast<T&>(*runtime.root().Find(path).value());
  }
};

}  // namespace runnel::testing
