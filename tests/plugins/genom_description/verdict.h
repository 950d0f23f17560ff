#pragma once

#include <string>
#include <vector>

namespace runnel::test {

/// "" if the description is right, else all that is wrong with it.
[[nodiscard]] std::string Wrongs(const std::string& text);

/// The same for what stands within a component, after these declarations.
[[nodiscard]] std::string WrongsInComponent(const std::string& items);

/// A description with its verdict.
struct Case {
  bool is_right;
  std::string text;
};

/// Expects each to be right or wrong as it says.
void ExpectVerdicts(const std::vector<Case>& cases);
void ExpectVerdictsInComponent(const std::vector<Case>& cases);

[[nodiscard]] std::string FileText(const std::string& name);

constexpr bool kRight = true;
constexpr bool kWrong = false;

}  // namespace runnel::test
