#include "core/base/unit.h"

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "core/base/characters.h"

namespace runnel {

namespace {

struct NamedUnit {
  std::string_view name;
  Unit unit;
  bool takes_prefix = false;
};

constexpr double kPi = std::numbers::pi;
constexpr std::array<NamedUnit, 21> kUnits{{
    {"m", {1, 1, {1}}, true},
    {"g", {1, 1, {0, 1}}, true},
    {"t", {1e6, 1, {0, 1}}},
    {"s", {1, 1, {0, 0, 1}}, true},
    {"min", {60, 1, {0, 0, 1}}},
    {"h", {3600, 1, {0, 0, 1}}},
    {"A", {1, 1, {0, 0, 0, 1}}, true},
    {"K", {1, 1, {0, 0, 0, 0, 1}}, true},
    {"rad", {1, 1, {0, 0, 0, 0, 0, 1}}, true},
    {"deg", {kPi, 180, {0, 0, 0, 0, 0, 1}}},
    {"°", {kPi, 180, {0, 0, 0, 0, 0, 1}}},
    {"rpm", {2 * kPi, 60, {0, 0, -1, 0, 0, 1}}},
    {"Hz", {1, 1, {0, 0, -1}}, true},
    {"N", {1000, 1, {1, 1, -2}}, true},
    {"J", {1000, 1, {2, 1, -2}}, true},
    {"W", {1000, 1, {2, 1, -3}}, true},
    {"Pa", {1000, 1, {-1, 1, -2}}, true},
    {"V", {1000, 1, {2, 1, -3, -1}}, true},
    {"Ohm", {1000, 1, {2, 1, -3, -2}}, true},
    {"%", {1, 100, {}}},
    {"1", {}},
}};

struct UnitPrefix {
  std::string_view name;
  double numerator;
  double denominator;
};
constexpr std::array<UnitPrefix, 10> kUnitPrefixes{{{"k", 1e3, 1},
                                                    {"M", 1e6, 1},
                                                    {"G", 1e9, 1},
                                                    {"d", 1, 10},
                                                    {"c", 1, 100},
                                                    {"m", 1, 1e3},
                                                    {"u", 1, 1e6},
                                                    {"µ", 1, 1e6},
                                                    {"μ", 1, 1e6},  // the Greek letter
                                                    {"n", 1, 1e9}}};

std::optional<Unit> FindUnit(std::string_view name) {
  for (const NamedUnit& each : kUnits) {
    if (each.name == name) return each.unit;
  }
  for (const UnitPrefix& prefix : kUnitPrefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (const NamedUnit& each : kUnits) {
      if (!each.takes_prefix || each.name != name.substr(prefix.name.size())) continue;
      Unit unit = each.unit;
      unit.numerator *= prefix.numerator;
      unit.denominator *= prefix.denominator;
      return unit;
    }
  }
  return std::nullopt;
}

// Of "s^2", "s2", "s²"; takes it off `name`. 0 if it is none that anybody uses.
int TakeExponent(std::string_view& name) {
  for (const auto& [sign, exponent] : {std::pair{"²", 2}, std::pair{"³", 3}}) {
    if (!name.ends_with(sign)) continue;
    name.remove_suffix(std::string_view(sign).size());
    return exponent;
  }
  if (name.size() < 2 || name.back() < '1' || name.back() > '9') return 1;
  const int exponent = name.back() - '0';
  name.remove_suffix(1);
  const bool is_negative = name.ends_with('-');
  if (is_negative) name.remove_suffix(1);
  if (name.ends_with('^')) name.remove_suffix(1);
  return exponent > 4 ? 0 : is_negative ? -exponent : exponent;
}

void Multiply(Unit& unit, const Unit& factor, int times) {
  for (int i = 0; i < std::abs(times); ++i) {
    unit.numerator *= times > 0 ? factor.numerator : factor.denominator;
    unit.denominator *= times > 0 ? factor.denominator : factor.numerator;
  }
  for (std::size_t i = 0; i < unit.dimensions.size(); ++i) {
    unit.dimensions[i] += times * factor.dimensions[i];
  }
}

// "m/s^2": what follows a '/' divides, up to the next one.
}  // namespace

std::optional<Unit> ParseUnit(std::string_view text) {
  constexpr std::string_view kSigns = "/* ";
  Unit unit;
  bool divides = false;
  text = Trimmed(text);
  while (true) {
    const std::size_t end = std::min(text.find_first_of(kSigns), text.size());
    std::string_view name = text.substr(0, end);
    const int exponent = TakeExponent(name);
    const auto factor = FindUnit(name);
    if (!factor || exponent == 0) return std::nullopt;
    Multiply(unit, *factor, divides ? -exponent : exponent);
    text.remove_prefix(end);
    if (text.empty()) return unit;
    divides = false;
    while (!text.empty() && kSigns.find(text.front()) != std::string_view::npos) {
      divides = divides || text.front() == '/';
      text.remove_prefix(1);
    }
  }
}

std::optional<UnitRatio> RatioOfUnits(std::string_view from, std::string_view to) {
  if (from == to) return UnitRatio{};
  const auto source = ParseUnit(from);
  const auto target = ParseUnit(to);
  if (!source || !target || source->dimensions != target->dimensions) return std::nullopt;
  return UnitRatio{source->numerator * target->denominator, source->denominator * target->numerator};
}

}  // namespace runnel
