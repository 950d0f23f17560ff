// A plugin that brings a module type, a tag and an attribute.

#include "core/module/group.h"
#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/output.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/xml_tag.h"

// Known to nobody before a module with a port of it is made.
struct BroughtValue {
  int number = 0;
};
static void Describe(runnel::TypeBuilder<BroughtValue>& type) { type.Name("test/brought_value"); }

namespace {

class Brought final : public runnel::Module {
 public:
  using Module::Module;
  runnel::Output<BroughtValue> value{this, "value"};

 private:
  void Update() override {}
};

}  // namespace

RUNNEL_PLUGIN(good_plugin, registry) {
  registry.Add<Brought>("good/brought", "for tests");
  auto* const tags = registry.Find<runnel::XmlTagRegistry>();
  if (tags == nullptr) return;
  tags->AddTag({.name = "tower",
                .parents = {"application"},
                .handle = [](const runnel::TagUse& use) -> runnel::FrameworkElement* {
                  return &use.context.runtime().Create<runnel::Group>(use.parent, "tower");
                }});
  tags->AddAttribute({.tag = "application",
                      .rule = {.name = "height", .kind = runnel::AttributeKind::kCount},
                      .handle = [](const runnel::XmlAttribute& attribute, runnel::FrameworkElement& element,
                                   runnel::BuildContext& context) {
                        context.runtime().Create<runnel::Group>(element, "height_" + attribute.value);
                      }});
}
