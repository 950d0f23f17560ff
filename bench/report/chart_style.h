#pragma once

#include <array>
#include <string>

#include "bench/report/measurement.h"

namespace runnel::bench {

// Runnel in one strong colour, all others quieter.
inline const std::string kQuiet = "#777";
inline const std::string kGrid = "#e4e4e4";
inline const std::string kOwnColour = "#d1495b";

inline std::string BarColour(Role role) {
  switch (role) {
    case Role::kRunnel:
      return kOwnColour;
    case Role::kFloor:
      return "#cfd8dc";
    default:
      return "#90a4ae";
  }
}

/// Of the lines of one chart, by number.
inline std::string LineColour(std::size_t number) {
  static const std::array<std::string, 6> colours = {"#30638e", "#3d9970", "#b8860b", "#7b5ea7", "#4aa3b5", "#8d6e63"};
  return colours[number % colours.size()];
}

inline std::string LabelOf(const Subject& subject) {
  return subject.role == Role::kRunnel ? "Runnel: " + subject.name : subject.name;
}

inline std::string TitleOf(const Quantity& quantity) {
  return quantity.name + " in " + quantity.unit + (quantity.more_is_better ? " (more is better)" : " (less is better)");
}

}  // namespace runnel::bench
