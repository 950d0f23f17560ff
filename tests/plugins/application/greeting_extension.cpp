// An extension as a plugin has it: says at the start what it was given.

#include <memory>
#include <string>

#include "core/plugin/plugin_entry.h"
#include "plugins/application/application_extension.h"

namespace {

class Greeting final : public runnel::ApplicationExtension {
 public:
  explicit Greeting(std::string text) : text_(std::move(text)) {}
  std::string StartText() const override { return text_ + "\n"; }

 private:
  const std::string text_;
};

}  // namespace

RUNNEL_PLUGIN(greeting, registry) {
  if (auto* const tags = registry.Find<runnel::XmlTagRegistry>()) {
    tags->AddTag({.name = "greeting", .parents = {"application", "group"}, .handle = [](const runnel::TagUse& use) {
                    return &use.parent;
                  }});
  }
  auto* const extensions = registry.Find<runnel::ExtensionRegistry>();
  if (extensions == nullptr) return;
  extensions->Add([](const runnel::ExtensionArguments& arguments) -> runnel::Result<runnel::Extensions> {
    std::string text = "hello";
    for (const std::string& name : arguments.All("name")) {
      if (name == "nobody") return runnel::Error{.message = "--name: nobody is greeted"};
      text += " " + name;
    }
    return runnel::Extensions{std::make_shared<Greeting>(text)};
  });
}
