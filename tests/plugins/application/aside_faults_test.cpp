// What a plugin has registered is taken out, to be loaded anew, and put back as a whole, while memory is short.

#include <functional>
#include <memory>
#include <new>
#include <string>

#include <gtest/gtest.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "plugins/application/application_checks.h"
#include "plugins/application_files/xml_tag.h"
#include "plugins/testing/fault_injection.h"
#include "plugins/wire/wire_engines.h"

namespace runnel::test {
namespace {

const std::string kLoadedAnew = "a plugin that is loaded anew";  // too long to be within the text itself

/// `has_all`: whether the registry has what the plugin has registered.
void EndureAside(OfferedRegistry& registry, const std::function<bool()>& has_all) {
  constexpr std::size_t kForAWhile = 1000;
  ASSERT_TRUE(has_all());
  const auto there_and_back = [&] {
    try {
      const auto back = registry.SetAside(kLoadedAnew);
      back();
    } catch (const std::bad_alloc&) {
    }
  };
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, there_and_back, [&](bool) { ASSERT_TRUE(has_all()); }, kForAWhile);
  EXPECT_GT(points, 0u);
}

TEST(AsideFaults, TagsAndAttributesAreTakenOutAndPutBack) {
  XmlTagRegistry tags;
  tags.AddTag({.name = "application", .parents = {}});
  const auto add = [&](const std::string& tag, const std::string& attribute) {
    tags.AddTag({.name = tag, .parents = {"application"}});
    tags.AddAttribute({.tag = "application",
                       .rule = {.name = attribute, .summary = "a text that is too long to be within itself"},
                       .handle = [](const XmlAttribute&, FrameworkElement&, BuildContext&) {}});
  };
  tags.set_plugin(kLoadedAnew);
  add("first", "a_first_attribute_of_a_long_name");
  tags.set_plugin("another");
  add("second", "a_second_attribute_of_a_long_name");
  tags.set_plugin(kLoadedAnew);
  add("third", "a_third_attribute_of_a_long_name");
  EndureAside(tags, [&] {
    return tags.FindTag("first") != nullptr && tags.FindTag("third") != nullptr &&
           tags.AddedAttributes("application").size() == 3;
  });
}

TEST(AsideFaults, ChecksAreTakenOutAndPutBack) {
  Runtime runtime;
  auto& application = runtime.Create<Group>(runtime.root(), "application");
  ApplicationChecks checks;
  std::string made;
  for (const std::string& plugin : {kLoadedAnew, std::string("another"), kLoadedAnew}) {
    checks.set_plugin(plugin);
    checks.Add([&made, plugin](const ApplicationCheckUse&) { made += plugin + ", "; });
  }
  EndureAside(checks, [&] {
    made.clear();
    Diagnostics diagnostics;
    checks.Run({application, diagnostics});
    const std::size_t first = made.find(kLoadedAnew);
    return made.find("another") != std::string::npos && first != std::string::npos &&
           made.find(kLoadedAnew, first + 1) != std::string::npos;
  });
}

TEST(AsideFaults, AnEngineIsTakenOutAndPutBack) {
  WireEngines engines;
  const auto owner = std::make_shared<int>();
  engines.set_plugin(kLoadedAnew);
  engines.Add(std::shared_ptr<WireEngine>(owner, static_cast<WireEngine*>(nullptr)));
  EndureAside(engines, [&] { return owner.use_count() == 2; });
}

}  // namespace
}  // namespace runnel::test
