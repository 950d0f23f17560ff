#include "core/plugin/module_registry.h"

#include <stdexcept>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/plugin/module_type_name.h"

namespace runnel {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

ModuleType TypeNamed(std::string name, std::string plugin = "motion") {
  return {std::move(name), "a type", std::move(plugin),
          [](const Placement& placement) { return std::make_unique<Group>(placement); }};
}

TEST(ModuleRegistryTest, ListsTypesByName) {
  ModuleRegistry registry;
  ASSERT_TRUE(registry.Add(TypeNamed("motion/guard")));
  ASSERT_TRUE(registry.Add(TypeNamed("motion/drive")));
  ASSERT_EQ(registry.All().size(), 2u);
  EXPECT_EQ(registry.All()[0]->name, "motion/drive");
  EXPECT_EQ(registry.All()[1]->name, "motion/guard");
}

TEST(ModuleRegistryTest, SecondTypeOfANameIsRefusedWithTheOwnerOfTheFirst) {
  ModuleRegistry registry;
  ASSERT_TRUE(registry.Add(TypeNamed("guard", "motion")));
  const auto again = registry.Add(TypeNamed("guard", "planning"));
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().message, "module type 'guard' comes with plugin 'motion' already");
  EXPECT_EQ(registry.Find("guard")->plugin, "motion");
}

TEST(ModuleRegistryTest, BadNamesAreRefused) {
  ModuleRegistry registry;
  EXPECT_FALSE(registry.Add(TypeNamed("")));
  EXPECT_FALSE(registry.Add(TypeNamed("two words")));
}

TEST(ModuleRegistryTest, MisspeltNameGetsTheNearestOne) {
  ModuleRegistry registry;
  ASSERT_TRUE(registry.Add(TypeNamed("motion/collision_guard")));
  const auto type = registry.Get("motion/colision_guard");
  ASSERT_FALSE(type);
  EXPECT_EQ(type.error().message, "there is no module type 'motion/colision_guard'");
  EXPECT_EQ(type.error().hint, "did you mean 'motion/collision_guard'?");
}

TEST(ModuleRegistryTest, ForgetsAllOfOnePlugin) {
  ModuleRegistry registry;
  ASSERT_TRUE(registry.Add(TypeNamed("a", "first")));
  ASSERT_TRUE(registry.Add(TypeNamed("b", "second")));
  (void)registry.SetAside("first");
  EXPECT_EQ(registry.Find("a"), nullptr);
  EXPECT_NE(registry.Find("b"), nullptr);
}

TEST(ModuleRegistryTest, CreatesModulesBelowTheirParent) {
  ModuleRegistry registry;
  Runtime runtime;
  ASSERT_TRUE(registry.Add(TypeNamed("group")));
  const auto made = registry.Create("group", runtime.root(), "robot");
  ASSERT_TRUE(made);
  EXPECT_EQ((*made)->path(), "/robot");
  EXPECT_TRUE(runtime.Delete(**made));
}

TEST(ModuleRegistryTest, ModulesRememberTheirType) {
  Runtime runtime;
  ModuleRegistry registry;
  ASSERT_TRUE(registry.Add(TypeNamed("motion/guard")));
  const auto made = registry.Create("motion/guard", runtime.root(), "guard");
  ASSERT_TRUE(made);
  EXPECT_EQ(FindModuleType(**made), "motion/guard");
  EXPECT_EQ(FindModuleType(runtime.Create<Group>(runtime.root(), "by_code")), "");
}

TEST(ModuleRegistryTest, WhatAConstructorThrowsIsAnErrorAndLeavesNothingBehind) {
  ModuleRegistry registry;
  Runtime runtime;
  auto failing = TypeNamed("failing");
  failing.make = [](const Placement& placement) -> std::unique_ptr<FrameworkElement> {
    const Group half_made(placement);
    throw std::runtime_error("the device is missing");
  };
  auto odd = TypeNamed("odd");
  odd.make = [](const Placement&) -> std::unique_ptr<FrameworkElement> { throw 7; };
  ASSERT_TRUE(registry.Add(failing));
  ASSERT_TRUE(registry.Add(odd));
  const auto made = registry.Create("failing", runtime.root(), "robot");
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().path, "/");
  EXPECT_EQ(made.error().message, "a module of type 'failing' could not be made: the device is missing");
  const auto other = registry.Create("odd", runtime.root(), "robot");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("exception of type int"));
  EXPECT_THAT(runtime.root().children(), IsEmpty());
}

TEST(ModuleRegistryTest, NameThatIsTakenIsAnErrorWithThePath) {
  ModuleRegistry registry;
  Runtime runtime;
  ASSERT_TRUE(registry.Add(TypeNamed("group")));
  ASSERT_TRUE(registry.Create("group", runtime.root(), "robot"));
  const auto again = registry.Create("group", runtime.root(), "robot");
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().path, "/");
  EXPECT_THAT(again.error().message, HasSubstr("already an element called 'robot'"));
}

}  // namespace
}  // namespace runnel
