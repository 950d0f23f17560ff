
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/world_file/world_file.h"

namespace runnel {
namespace {

World EveryPart() {
  return {
      .name = "a \"name\" & <more>\n\t'end'",
      .start = {-6, 1.0 / 3.0, 1e-7},
      .goal = {7, -1e-300},
      .polygons = {{.outline = {{0, 0}, {4, 0}, {0, 4}}, .holes = {{{0.5, 0.5}, {1, 0.5}, {0.5, 1}}}, .height = 0.1}},
      .boxes = {{.pose = {1, -3, 0.2}, .length = 2, .width = 1, .height = 3}},
      .cylinders = {{.centre = {-1, -3}, .radius = 0.1 + 0.2, .height = 2}},
      .walls = {{.points = {{-2, 1}, {-2, 3}}, .thickness = 0.1, .height = 0.7}},
      .bounds = Ring{{-9, -9}, {9, -9}, {0, 20}}};
}

TEST(WriteWorld, LosesNothingWhenReadAgain) {
  Diagnostics diagnostics;
  EXPECT_EQ(ReadWorld(WriteWorld(EveryPart()), "w.xml", diagnostics), EveryPart()) << diagnostics.ToString();
}

TEST(WriteWorld, LeavesOutWhatIsUsual) {
  const World world{.name = "w", .start = {1, 2, 0}, .cylinders = {{.centre = {5, 5}, .radius = 1}}};
  EXPECT_EQ(WriteWorld(world),
            "<world name=\"w\">\n"
            "  <start x=\"1\" y=\"2\"/>\n"
            "  <goal x=\"0\" y=\"0\"/>\n"
            "  <cylinder x=\"5\" y=\"5\" radius=\"1\"/>\n"
            "</world>\n");
}

}  // namespace
}  // namespace runnel
