#pragma once

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/paths/path_search.h"
#include "core/port/driving_ports.h"
#include "core/port/port_stop.h"
#include "tests/plugins/application_tags/driving_swap_fixture.h"

/// Every kind of module that moves something, or may, by itself and as a part of a composite.
namespace runnel::testing::driving_swap {

inline constexpr std::array kUnits = {"", "m/s", "rad", "us"};
struct Declaration {
  const char* name;
  InputOptions options;
};
inline const std::array kDeclarations = {
    Declaration{"nothing", {}},
    Declaration{"velocity0", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(0.0)}},
    Declaration{"velocity1500", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(1500.0)}},
    Declaration{"position0.3", {.drives = true, .command = DrivingKind::kPosition, .safe_value = AnyValue(0.3)}},
    Declaration{"effort0", {.drives = true, .command = DrivingKind::kEffort, .safe_value = AnyValue(0.0)}},
};
inline const InputOptions& DeclarationOf(std::size_t variant) { return kDeclarations[variant % 5].options; }

inline constexpr std::size_t kModules = kUnits.size() * 5, kVariants = 2 * kModules;
inline bool IsComposite(std::size_t variant) { return variant >= kModules; }
inline std::string Name(std::size_t variant) {
  const std::size_t module = variant % kModules;
  return std::string(IsComposite(variant) ? "box/" : "test/") + kDeclarations[module % 5].name + "_" +
         std::to_string(module / 5);
}

inline bool fails = false;  // the module that is made next
inline InputOptions Options(std::size_t unit, std::size_t declaration) {
  InputOptions options = kDeclarations[declaration].options;
  options.unit = kUnits[unit];
  return options;
}
template <std::size_t kIndex>
struct Variant final : Module {
  using Module::Module;
  Input<double> in{this, "in", Options(kIndex / 5, kIndex % 5)};
  const bool is_bad = fails;
  void Update() override {
    if (is_bad) throw std::runtime_error("no such device");
  }
};
template <std::size_t kIndex>
struct Box final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().template Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    return Port::Connect(in, runtime().template Create<Variant<kIndex>>(*this, "part").in);
  }
};

struct Stop {
  bool drives = false;
  double safe = 0;
  DrivingKind command = DrivingKind::kUnspecified;
  Duration brake{};
  bool operator==(const Stop&) const = default;
};

struct TableOfVariants : ::testing::TestWithParam<std::size_t> {
  template <std::size_t... kIndex>
  void Know(SavingWorkshop& workshop, std::index_sequence<kIndex...>) {
    (workshop.Add<Variant<kIndex>>("test/" + Name(kIndex).substr(5)), ...);
    (workshop.Add<Box<kIndex>>(Name(kModules + kIndex)), ...);
    workshop.Add<Keeper>("test/keeper");
  }
  bool Load(const std::string& type, const std::string& said) {
    history.reset();
    editor.reset();
    scheduler.reset();
    shop.emplace();
    Know(*shop, std::make_index_sequence<kModules>());
    const std::string mark = said.empty() ? "" : "<driving port=\"m/in\"" + said + "/>";
    WriteAll(folder / "app.xml",
             "<application name=\"demo\"><module name=\"s\" type=\"test/keeper\"/><module name=\"m\" type=\"" + type +
                 "\"/><connect from=\"s/value\" to=\"m/in\"/>" + mark + "</application>");
    if (!BuildApplication(folder / "app.xml", {shop->runtime, shop->plugins, shop->tags, shop->configuration},
                          BuildMode::kRun)
             .diagnostics.ok())
      return false;
    scheduler.emplace(shop->runtime, SchedulerOptions{.clock = SchedulerOptions::ClockKind::kSimulated});
    editor.emplace(shop->runtime, shop->plugins.modules(), &*scheduler);
    history.emplace(*editor);
    return true;
  }
  /// The port of the place, and what reads there.
  static Port& In(SavingWorkshop& workshop, const std::string& module = "/demo/m") {
    return **PathSearch(workshop.Get<FrameworkElement>(module)).FindPort("in", PathKind::kInput);
  }
  static Input<double>& Reader(SavingWorkshop& workshop, const std::string& module = "/demo/m") {
    return dynamic_cast<Input<double>&>(*In(workshop, module).Sinks().front());
  }
  /// That of which it has the safe value under STOP.
  static Stop StopAt(SavingWorkshop& workshop, const std::string& module = "/demo/m") {
    for (const auto& [stop, safe] : internal::PassedStops(Reader(workshop, module))) {
      if (stop->robot()) return {true, Number(safe), stop->command(), stop->brake()};
    }
    return {};
  }
  std::string Text() { return shop->Text(shop->Get<FrameworkElement>("/demo"), folder.path()); }

  TestFolder folder;
  std::optional<SavingWorkshop> shop;
  std::optional<Scheduler> scheduler;
  std::optional<StructureEditor> editor;
  std::optional<ChangeHistory> history;
};

}  // namespace runnel::testing::driving_swap
