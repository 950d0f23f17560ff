#pragma once

#include <string>
#include <string_view>

namespace runnel {

/// "AddNoise Front" → "add_noise_front": how Runnel would call what FINROC calls so. Letters, digits
/// and '_' only, never empty.
[[nodiscard]] std::string SnakeCase(std::string_view name);

/// "/Control/Sensor%20Input/Pose" → "control/sensor_input/pose", without '/' at either end.
[[nodiscard]] std::string SnakeCasePath(std::string_view path);

/// "finroc_projects_crash_course" → "crash_course": what a library of FINROC is about.
[[nodiscard]] std::string LibraryName(std::string_view library);

}  // namespace runnel
