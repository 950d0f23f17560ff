#pragma once

#include <string>
#include <string_view>

namespace runnel {

/// "AddNoise Front" → "add_noise_front": how Runnel would call what FINROC calls so. Letters, digits
/// and '_' only, never empty.
[[nodiscard]] std::string RunnelName(std::string_view name);

/// "/Control/Sensor%20Input/Pose" → "control/sensor_input/pose", without '/' at either end.
[[nodiscard]] std::string RunnelPath(std::string_view path);

/// "a/b/c" without the last two names: "a".
[[nodiscard]] std::string WithoutLast(const std::string& path, int count);
/// "c" of "a/b/c".
[[nodiscard]] std::string LastName(const std::string& path);

/// "finroc_projects_crash_course" → "crash_course": what a library of FINROC is about.
[[nodiscard]] std::string LibraryName(std::string_view library);

}  // namespace runnel
