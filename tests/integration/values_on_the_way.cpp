#include "tests/integration/values_on_the_way.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "modules/types/algorithm/measurements.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel::test {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <typename T>
void Reset(void* value) {
  *static_cast<T*>(value) = T{};
}
template <typename T>
void SpoilNumbers(void* value) {
  auto& spoiled = *static_cast<T*>(value);
  if constexpr (std::is_same_v<T, Pose2>) spoiled = {kNaN, kNaN, kNaN};
  if constexpr (std::is_same_v<T, Twist2>) spoiled = {kNaN, kNaN};
  if constexpr (std::is_same_v<T, WheelSpeeds>) spoiled = {kNaN, kNaN};
  if constexpr (std::is_same_v<T, InfraredRanges>) spoiled.front = kNaN;
  if constexpr (std::is_same_v<T, RangeScan>) std::ranges::fill(spoiled.ranges, static_cast<float>(kNaN));
}
// 40 % of the rays, in a row, the middle among them.
void SpoilPart(void* value) {
  auto& ranges = static_cast<RangeScan*>(value)->ranges;
  const auto first = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 4);
  std::fill_n(first, 2 * ranges.size() / 5, static_cast<float>(kNaN));
}

std::vector<OnTheWay> BugWay(OnTheWay sensor) {
  return {{"/localisation/pose", "/robot/pose", "/localisation", SpoilNumbers<Pose2>},
          std::move(sensor),
          {"/robot/eyes/surroundings", "/robot/planner/surroundings", "/robot/eyes", nullptr, Reset<Surroundings>},
          {"/robot/planner/twist", "/robot/gate/wanted", "/robot/planner", SpoilNumbers<Twist2>},
          {"/robot/gate/allowed", "/robot/drive/twist", "/robot/gate", SpoilNumbers<Twist2>},
          {"/robot/drive/wheels", "/robot/wheels", "/robot/drive", SpoilNumbers<WheelSpeeds>},
          {"/bumper/contact", "/robot/contact", "/bumper"}};
}
const OnTheWay kScan{"/laser/scan", "/robot/scan", "/laser", SpoilNumbers<RangeScan>, Reset<RangeScan>, SpoilPart};
const OnTheWay kRanges{"/infrared/ranges", "/robot/ranges", "/infrared", SpoilNumbers<InfraredRanges>,
                       Reset<InfraredRanges>};

}  // namespace

std::vector<Demo> Demos() {
  return {
      {"bug_demo.xml", BugWay(kScan)},
      {"bug_infrared.xml", BugWay(kRanges)},
      {"behaviour_demo.xml",
       {{"/localisation/pose", "/network/pose", "/localisation", SpoilNumbers<Pose2>},
        {"/laser/scan", "/eyes/scan", "/laser", SpoilNumbers<RangeScan>, Reset<RangeScan>, SpoilPart},
        {"/eyes/surroundings", "/network/surroundings", "/eyes", nullptr, Reset<Surroundings>},
        {"/network/drive/twist", "/network/motion/in1", "/network/drive", SpoilNumbers<Twist2>, nullptr, nullptr, true},
        {"/network/avoid/activity", "/network/motion/activity2", "/network/avoid"},
        {"/network/emergency_stop/activity", "/network/safe_motion/activity1", "/network/emergency_stop"},
        {"/network/motion/out", "/network/emergency_stop/wanted", "/network/motion", SpoilNumbers<Twist2>},
        {"/network/safe_motion/out", "/network/twist", "/network/safe_motion", SpoilNumbers<Twist2>},
        {"/gate/allowed", "/wheels/twist", "/gate", SpoilNumbers<Twist2>},
        {"/wheels/wheels", "/world/wheels", "/wheels", SpoilNumbers<WheelSpeeds>},
        {"/bumper/contact", "/gate/contact", "/bumper"}}},
      {"genom_demo.xml",
       {{"/localisation/pose", "/guide/pose", "/localisation", SpoilNumbers<Pose2>},
        {"/laser/scan", "/eyes/scan", "/laser", SpoilNumbers<RangeScan>, Reset<RangeScan>, SpoilPart},
        {"/eyes/surroundings", "/guide/surroundings", "/eyes", nullptr, Reset<Surroundings>},
        {"/guide/twist", "/drive/twist", "/guide", SpoilNumbers<Twist2>},
        {"/drive/wheels", "/world/wheels", "/drive", SpoilNumbers<WheelSpeeds>}},
       "guide/output/go_to",
       "{to: {x: 5.6, y: 0.5}}"}};
}

}  // namespace runnel::test
